(define (domain shelves)
  (:requirements :typing :fluents :equality :disjunctive-preconditions)
  (:types cup place)
  (:constants sink - place)
  (:predicates (clean ?c - cup) (near ?a ?b - place))
  (:functions
    (water) - number
    (home ?c - cup) - place
    (distance ?a ?b - place))
  (:action wash
    :parameters (?c - cup)
    :precondition (and (= (home ?c) sink) (> (water) 0.5) (or (near (home ?c) sink) (= (home ?c) (home ?c))))
    :effect (and (clean ?c) (decrease (water) (distance (home ?c) sink))))
  (:action move
    :parameters (?c - cup ?to - place)
    :precondition (and (not (= ?to sink)) (< (distance (home ?c) ?to) (* 2 (+ 1 (water)))))
    :effect (and (assign (home ?c) ?to) (near (home ?c) ?to) (increase (distance (home ?c) ?to) 1)))
  (:action forget
    :parameters (?c - cup)
    :effect (assign (home ?c) undefined)))
