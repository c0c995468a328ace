;@ (:seen "run.jsonl" 3)
(define (domain an)
 ;@ (:measured (off ?a ?b - object)
 ;@   (height ?a))
 (:predicates (on ?a ?b)) ; caveat: allow(unused-predicate)
 ;; caveat: allow(W0101, unused-paramter, unknown-predicate)
 (:action s :parameters (?a ?b)
  :precondition (and
   ;@ (:causal "m.json" :outcome (= on 1) :at-least 0.9
   ;@   :bind ((x (off ?a ?b) :nominal 0 :sd 0.4)))
   (on ?a ?b))
  :effect ()))
;@ (
