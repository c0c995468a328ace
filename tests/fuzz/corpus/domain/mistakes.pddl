(define (domain m
 (:requirement :typng :strip)
 (:predicate (p ?x -object) (p ?y) (q) q ?z)
 (action a :parameter (?x) :preconditions (and (p) (r ?x) (q ?y) (when (q) (p ?x))) :effects (or (q) (imply (q) (q))) :effect 5)
 (:action :parameters ?x :effect (not (q) (q)))
 (:action a a a)
 (:bogus (x)) 7 :loose
