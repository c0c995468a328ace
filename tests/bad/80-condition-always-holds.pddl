; expect: W0409 at 17:13-17:23
; with: good/adl-problem.pddl
(define (domain lamps)
  (:requirements :adl :derived-predicates)
  (:types lamp room)
  (:predicates
    (in ?l - lamp ?r - room)
    (lit ?l - lamp)
    (old ?l - lamp)
    (dark ?r - room))
  (:derived (dark ?r - room)
    (forall (?l - lamp) (or (not (in ?l ?r)) (not (lit ?l)))))
  (:action light
    :parameters (?l - lamp ?r - room)
    :precondition (and (in ?l ?r) (dark ?r) (not (lit ?l)))
    :effect (and (lit ?l)
      (when (in ?l ?r) (not (old ?l)))))
  (:action quench
    :parameters (?r - room)
    :precondition (not (dark ?r))
    :effect (forall (?l - lamp)
      (when (in ?l ?r) (not (lit ?l))))))
