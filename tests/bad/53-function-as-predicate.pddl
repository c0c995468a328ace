; expect: E0205 at 14:59-14:64
; with: good/cost-problem.pddl
(define (domain harbour)
  (:requirements :strips :typing :action-costs)
  (:types ship berth)
  (:predicates
    (at ?s - ship ?b - berth)
    (channel ?from ?to - berth))
  (:functions
    (miles ?from ?to - berth) - number
    (total-cost) - number)
  (:action sail
    :parameters (?s - ship ?from ?to - berth)
    :precondition (and (at ?s ?from) (channel ?from ?to) (miles ?from ?to))
    :effect (and (not (at ?s ?from)) (at ?s ?to)
                 (increase (total-cost) (miles ?from ?to)))))
