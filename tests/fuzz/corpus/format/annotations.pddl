;@author somebody
(define (domain d) ;@ (:measured (weight ?c - cube)) ; grams
  ;@ (:exactly-one (clean ?d)
;@
;@(dirty ?d)) (:seen "a  (file;" 3

  (:predicates (clean ?d) ;@ (:seen
    ;@ 3)
    (dirty ?d)) ;@ )
  (:action wash :precondition (and (dirty ?d)
;@ (:causal "wash.json" :outcome (= clean 1) :at-least 0.9 :bind ((water (amount ?d) :nominal 2 :sd 0.3) (soap (grams ?d) :from (pour ?d)))))
)))
