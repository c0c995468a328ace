; expect: E0101 at 16:35-16:41
; with: good/agents-problem.pddl
(define (domain piano)
  (:requirements :adl :multi-agent)
  (:types mover piano room)
  (:predicates
    (in ?m - mover ?r - room)
    (stands ?p - piano ?r - room)
    (raised ?p - piano)
    (tired ?m - mover))
  (:action raise
    :agent ?m - mover
    :parameters (?p - piano ?r - room)
    :precondition (and (in ?m ?r) (stands ?p ?r) (not (tired ?m))
      (exists (?other - mover)
        (and (not (= ?other ?m)) (riased ?other ?p ?r))))
    :effect (and (raised ?p) (tired ?m)))
  (:action walk
    :agent ?m - mover
    :parameters (?from ?to - room)
    :precondition (in ?m ?from)
    :effect (and (not (in ?m ?from)) (in ?m ?to))))
