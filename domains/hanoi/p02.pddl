;; Three cubes, three spots: 2^3 - 1 = 7 moves.
(define (problem hanoi-p02)
  (:domain hanoi)
  (:objects
    small medium large - cube
    left middle right - spot)
  (:init
    (smaller small medium) (smaller small large) (smaller small left) (smaller small middle) (smaller small right)
    (smaller medium large) (smaller medium left) (smaller medium middle) (smaller medium right)
    (smaller large left) (smaller large middle) (smaller large right)
    (onTop large left) (onTop medium large) (onTop small medium) (clear small)
    (clear middle)
    (clear right))
  (:goal
    (and
      (onTop large right)
      (onTop medium large)
      (onTop small medium))))
