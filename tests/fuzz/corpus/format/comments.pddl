; a

(define ; b
 (domain d) ; c
 ; d
 (:predicates ; e
 (p ?x) ; f


 (q)) ; g
 (:action a :parameters () ; h
 :effect (and ; i
 ; j
 )) ; k
)
; l