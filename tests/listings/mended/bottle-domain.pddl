; caveat: allow(shared-fact)
(define (domain bottle)
(:requirements :adl :multi-agent)
(:types agent thing - object lid bottle - thing)
(:predicates
  (inHand ?t - thing ?a - agent)
  (closed ?bot - bottle ?l - lid))
(:action unscrew
  :agent ?a - agent
  :parameters (?l - lid ?bot - bottle)
  :precondition (and
    (not (inHand ?l ?a))
    (closed ?bot ?l) ; bottle is closed by a lid
    (exists (?b - agent) (hold ?b ?bot ?l)))
:effect (and
    (inHand ?l ?a)
    (not (closed ?bot ?l)))
)

(:action hold
  :agent ?a - agent
  :parameters (?bot - bottle ?l - lid)
  :precondition (and
    (inHand ?bot ?a)
    (closed ?bot ?l)
    (exists (?b - agent) (unscrew ?b ?l ?bot)))
  :effect (not (closed ?bot ?l))
)
)
