; expect: E0107 at 14:42-14:48
(define (domain harbour)
  (:requirements :strips :typing :action-costs)
  (:types ship berth)
  (:predicates
    (at ?s - ship ?b - berth)
    (channel ?from ?to - berth))
  (:functions
    (total-cost) - number)
  (:action sail
    :parameters (?s - ship ?from ?to - berth)
    :precondition (and (at ?s ?from) (channel ?from ?to))
    :effect (and (not (at ?s ?from)) (at ?s ?to)
                 (increase (total-cost) (milage ?from ?to)))))
