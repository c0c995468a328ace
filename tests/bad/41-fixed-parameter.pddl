; expect: W0107 at 15:60-15:69
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
    :parameters (?l ?o - lamp ?r - room)
    :precondition (and (in ?l ?r) (dark ?r) (not (lit ?l)) (= ?o ?l))
    :effect (and (lit ?l)
      (when (old ?l) (not (old ?l)))))
  (:action quench
    :parameters (?r - room)
    :precondition (not (dark ?r))
    :effect (forall (?l - lamp)
      (when (in ?l ?r) (not (lit ?l))))))
