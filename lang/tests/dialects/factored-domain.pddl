(define (domain sorting)
  (:requirements :typing :factored-privacy)
  (:types arm cup place)
  (:predicates
    (at ?c - cup ?p - place)
    (:private (holds ?arm - arm ?c - cup)))
  (:action take
    :parameters (?a - arm ?c - cup ?p - place)
    :precondition (at ?c ?p)
    :effect (and (holds ?a ?c) (not (at ?c ?p)))))
