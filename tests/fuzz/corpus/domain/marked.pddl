(define (domain é)
 (:predicates (p ?ü) (–) (ß x))
 (:action ÅÄ :parameters (?ü – object)
 :effect (p ?Ü)))
