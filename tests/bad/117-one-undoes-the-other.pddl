; expect: W0806 at 17:18-17:28
(define (domain laundry)
  (:requirements :typing :multi-agent)
  (:types helper shirt)
  (:predicates
    (clean ?s - shirt)
    (worn ?h - helper ?s - shirt)
    (spare ?s - shirt))
  (:action put-on
    :agent ?h - helper
    :parameters (?s - shirt)
    :precondition (clean ?s)
    :effect (and (worn ?h ?s) (not (clean ?s))))
  (:action wash
    :agent ?h - helper
    :parameters (?s - shirt)
    :effect (and (clean ?s) (spare ?s))))
