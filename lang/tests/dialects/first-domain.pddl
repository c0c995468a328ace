(define (domain blocks-1998)
  (:requirements :strips :domain-axioms :disjunctive-preconditions)
  (:predicates (on ?x ?y) (above ?x ?y) (clear ?x))
  (:axiom
    :vars (?x ?y ?z)
    :context (or (on ?x ?y) (and (on ?x ?z) (above ?z ?y)))
    :implies (above ?x ?y))
  (:action put
    :parameters (?x ?y)
    :precondition (and (clear ?x) (clear ?y))
    :effect (and (on ?x ?y) (not (clear ?y)))))
