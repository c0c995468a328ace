(define (domain ball) (:requirements :fluents :time :negative-preconditions)
 (:predicates (held)) (:functions (v) (h))
 (:process fall :parameters () :precondition (and (not (held)) (>= (h) 0)) :effect (and (increase (v) (* #t 9.8)) (decrease (h) (* #t (v)))))
 (:event bounce :parameters () :precondition (and (<= (h) 0) (> (v) 0)) :effect (assign (v) (* -0.9 (v)))))