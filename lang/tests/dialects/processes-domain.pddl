(define (domain kettle)
  (:requirements :typing :time :negative-preconditions)
  (:types pot)
  (:predicates (on ?p - pot) (boiling ?p - pot))
  (:functions (heat ?p - pot) (power))
  (:action switch-on
    :parameters (?p - pot)
    :precondition (not (on ?p))
    :effect (on ?p))
  (:process heating
    :parameters (?p - pot)
    :precondition (and (on ?p) (< (heat ?p) 100))
    :effect (increase (heat ?p) (* #t (power))))
  (:event boil
    :parameters (?p - pot)
    :precondition (and (>= (heat ?p) 100) (not (boiling ?p)))
    :effect (and (boiling ?p) (assign (heat ?p) 100))))
