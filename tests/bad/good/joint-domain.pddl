; Near misses of what is surely not meant when agents act together.
(define (domain joint)
  (:requirements :adl :multi-agent)
  (:types helper shirt door)
  (:predicates
    (clean ?s - shirt)
    (worn ?h - helper ?s - shirt)
    (free ?s - shirt)
    (open ?d - door)
    (through ?h - helper)
    (raised ?d - door))
  ; What one adds another deletes, but they demand the opposite of one another.
  (:action wash
    :agent ?h - helper
    :parameters (?s - shirt)
    :precondition (not (clean ?s))
    :effect (clean ?s))
  (:action soil
    :agent ?h - helper
    :parameters (?s - shirt)
    :precondition (clean ?s)
    :effect (not (clean ?s)))
  ; Two could take one shirt, but each forbids it, whichever words are used.
  (:action put-on
    :agent ?h - helper
    :parameters (?s - shirt)
    :precondition (and (free ?s) (forall (?o - helper) (imply (put-on ?o ?s) (= ?o ?h))))
    :effect (and (not (free ?s)) (worn ?h ?s)))
  (:action take-off
    :agent ?h - helper
    :parameters (?s - shirt)
    :precondition (worn ?h ?s)
    :effect (and (free ?s) (not (worn ?h ?s))))
  ; Each of two needs the other one, and the name of a predicate is that of an action that nobody asks for.
  (:action raise
    :agent ?h - helper
    :parameters (?d - door)
    :precondition (exists (?o - helper) (and (not (= ?o ?h)) (raise ?o ?d)))
    :effect (raised ?d))
  (:action open
    :agent ?h - helper
    :parameters (?d - door)
    :precondition (and (raised ?d) (not (open ?d)))
    :effect (open ?d))
  ; An effect that looks at its own action.
  (:action pass
    :agent ?h - helper
    :parameters (?d - door)
    :precondition (open ?d)
    :effect (and (through ?h)
      (when (forall (?o - helper) (imply (pass ?o ?d) (= ?o ?h))) (not (open ?d))))))
