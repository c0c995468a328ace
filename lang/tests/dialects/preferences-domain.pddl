(define (domain dishes)
  (:requirements :adl :preferences :constraints)
  (:types cup)
  (:predicates (clean ?c - cup) (wet) (piled ?c - cup))
  (:constraints (preference no-pile (always (forall (?c - cup) (not (piled ?c))))))
  (:action wash
    :parameters (?c - cup)
    :precondition (and (piled ?c) (preference dry-hands (not (wet))))
    :effect (and (clean ?c) (wet) (not (piled ?c)))))
