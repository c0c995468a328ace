;; Circuits: a crew restores a power network by switching lines and repairing them.
;;
;; Where current flows is nothing that an action sets: it follows from the switches, so it is derived.
;; Derived predicates are worked out in layers, and only a finished layer may be negated:
;; first `powered`, which calls itself, then `live` and `alarm`, which look at it from above.

(define (domain circuits)
  (:requirements :strips :typing :negative-preconditions :disjunctive-preconditions
    :existential-preconditions :derived-predicates)

  (:types node line - object)

  (:predicates
    (joins ?line - line ?one ?other - node)   ; the line runs between the nodes; stated both ways
    (feeds ?node - node)                      ; a power plant stands at the node
    (critical ?node - node)                   ; a hospital hangs on the node
    (closed ?line - line)                     ; the line's switch is closed, so current can pass
    (broken ?line - line)                     ; the line must be repaired before it can be closed
    (powered ?node - node)                    ; derived: current arrives at the node
    (live ?line - line)                       ; derived: there is current at an end of the line
    (alarm))                                  ; derived: a hospital is without current

  ;; Current arrives where it is made, and wherever a closed line leads from a powered node.
  (:derived (powered ?node - node)
    (or
      (feeds ?node)
      (exists (?line - line ?other - node)
        (and (joins ?line ?other ?node) (closed ?line) (powered ?other)))))

  (:derived (live ?line - line)
    (exists (?one ?other - node)
      (and (joins ?line ?one ?other) (powered ?one))))

  (:derived (alarm)
    (exists (?node - node)
      (and (critical ?node) (not (powered ?node)))))

  (:action close-switch
    :parameters (?line - line)
    :precondition (and (not (closed ?line)) (not (broken ?line)))
    :effect (closed ?line))

  (:action open-switch
    :parameters (?line - line)
    :precondition (closed ?line)
    :effect (not (closed ?line)))

  ;; The crew touches no line that has current at either end, and sets out only while no hospital is dark:
  ;; the ends must be cut off first, and the hospitals fed another way.
  (:action repair
    :parameters (?line - line)
    :precondition (and
      (broken ?line)
      (not (live ?line))
      (not (alarm)))
    :effect (not (broken ?line))))
