(define (domain sorting)
  (:requirements :typing :multi-agent :unfactored-privacy :concurrency-network)
  (:types arm cup place)
  (:constants table1 - place)
  (:predicates
    (at ?c - cup ?p - place)
    (:private ?arm - arm
      (holds ?arm - arm ?c - cup)
      (reaches ?arm - arm ?p - place)))
  (:action take
    :agent ?a - arm
    :parameters (?c - cup ?p - place)
    :precondition (and (at ?c ?p) (reaches ?a ?p))
    :effect (and (holds ?a ?c) (not (at ?c ?p))))
  (:concurrency-constraint one-hand-per-place
    :parameters (?p - place)
    :bounds (1 1)
    :actions ((take 2)))
  (:concurrency-constraint together
    :parameters (?c - cup ?p - place)
    :bounds (2 inf)
    :actions ((take 1 2)))
  (:positive-dependence one-hand-per-place together))
