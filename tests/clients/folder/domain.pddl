; Cups that are washed and moved between places.
(define (domain tidy)
  (:requirements :typing :negative-preconditions)
  (:types cup place)
  (:constants sink - place)
  (:predicates
    ; where a cup stands
    (at ?c - cup ?p - place)
    (clean ?c - cup)
    (free ?p - place)) ; nothing stands there
  (:action wash
    :parameters (?c - cup)
    :precondition (and (at ?c sink) (not (clean ?c)))
    :effect (clean ?c))
  (:action move
    :parameters (?c - cup ?from ?to - place)
    :precondition (and (at ?c ?from) (free ?to))
    :effect (and (at ?c ?to) (free ?from)
      (not (at ?c ?from)) (not (free ?to)))))
