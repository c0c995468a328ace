(define (domain k) (:requirements :constraints :preferences)
 (:predicates (p ?x) (q))
 (:constraints (and (always (q)) (forall (?x) (sometime-after (p ?x) (q))) (within 5 (q)) (hold-during 1 2 (q)) (preference n (at-most-once (q)))))
 (:action a :parameters (?x) :precondition (and (preference (q)) (preference m (p ?x))) :effect (q)))