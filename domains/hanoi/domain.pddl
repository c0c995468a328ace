;; Hanoi: the towers of Hanoi with cubes of growing size instead of discs.
;;
;; A cube may stand on a spot or on a larger cube, never on a smaller one.
;; Spots and cubes are both a `base`, so that one action serves for all moves.

(define (domain hanoi)
  (:requirements :strips :typing)

  (:types cube spot - base)

  (:predicates
    (onTop ?cube - cube ?base - base)     ; the cube stands on the base
    (clear ?base - base)                  ; nothing stands on the base
    (smaller ?cube - cube ?base - base))  ; the cube may stand on the base

  ;; Lift a cube with nothing on it from one base to another in a single step.
  (:action move
    :parameters (?cube - cube ?from ?to - base)
    :precondition (and
      (clear ?cube)
      (onTop ?cube ?from)
      (clear ?to)
      (smaller ?cube ?to))
    :effect (and
      (onTop ?cube ?to)
      (clear ?from)
      (not (onTop ?cube ?from))
      (not (clear ?to)))))
