(define (domain pr) (:requirements :probabilistic-effects :non-deterministic :rewards)
 (:predicates (p) (q))
 (:action a :effect (probabilistic 0.5 (p) 1/3 (and (q) (increase (reward) 2))))
 (:action b :effect (oneof (p) (and (q) (not (p))))) (:action c :observe (p)))