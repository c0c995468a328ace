; expect: W0402 at 15:50-15:59
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
    :precondition (and (in ?l ?r) (dark ?r) (not (= ?l ?l)) (not (lit ?l)))
    :effect (and (lit ?l)
      (when (old ?l) (not (old ?l)))))
  (:action quench
    :parameters (?r - room)
    :precondition (not (dark ?r))
    :effect (forall (?l - lamp)
      (when (in ?l ?r) (not (lit ?l))))))
