; expect: E0206 at 9:62-9:68
(define (domain tanks)
  (:requirements :typing :numeric-fluents)
  (:types tank)
  (:predicates (joined ?a ?b - tank))
  (:functions (level ?t - tank) (room ?t - tank))
  (:action pour
    :parameters (?a ?b - tank)
    :precondition (and (joined ?a ?b) (>= (level ?a) 1) (>= (joined ?a ?b) 1))
    :effect (and (decrease (level ?a) 1) (increase (room ?a) 1)
                 (increase (level ?b) 1) (decrease (room ?b) 1))))
