; expect: W0808 at 18:39-18:54
; with: good/agents-problem.pddl
(define (domain piano)
  (:requirements :adl :multi-agent)
  (:types mover piano room)
  (:predicates
    (in ?m - mover ?r - room)
    (stands ?p - piano ?r - room)
    (raised ?p - piano)
    (tired ?m - mover))
  (:action walk
    :agent ?m - mover
    :parameters (?from ?to - room)
    :precondition (in ?m ?from)
    :effect (and (not (in ?m ?from)) (in ?m ?to)))
  (:action raise
    :agent ?m - mover :parameters (?p - piano ?r - room)
    :precondition (and (stands ?p ?r) (walk ?m ?r ?r) (not (tired ?m)))
    :effect (and (raised ?p) (tired ?m))))
