;; Moves: robots on spots, of which some have room for all and the others for one robot each.
;;
;; `standardMove`, `constrainedMove1` and `constrainedMove2` follow the thesis, section 3.1.4, which prints them as three ways to move.
;; Here they stand side by side: the first leads to an `open` spot, the others to a `narrow` one.
;; Mended here, because the printed text is not PDDL or leaves something out:
;; - A robot goes only where a path leads; the printed text asks only whether it can be there at all.
;; - Two robots do not follow a third to the same spot.
;; - A robot may follow one that itself follows, so that a whole train moves in one step.
;; - Two robots on neighbouring narrow spots do not change places, since they would meet on the way.

(define (domain moves)
  (:requirements :adl :multi-agent)

  (:types
    robot spot - object
    open narrow - spot)

  (:predicates
    (isAgentAtSpot ?a - robot ?spot - spot)     ; the robot is at the spot
    (reachable ?spot - spot ?a - robot)         ; the robot fits there
    (path ?spot1 ?spot2 - spot))                ; a path leads from the one to the other

  ;; Go where there is room for all.
  (:action standardMove
    :agent ?a - robot
    :parameters (?spot1 - spot ?spot2 - open)
    :precondition (and
      (isAgentAtSpot ?a ?spot1)
      (reachable ?spot2 ?a)
      (path ?spot1 ?spot2))
    :effect (and
      (not (isAgentAtSpot ?a ?spot1))
      (isAgentAtSpot ?a ?spot2)))

  ;; Go to an empty spot to which nobody else goes.
  (:action constrainedMove1
    :agent ?a - robot
    :parameters (?spot1 - spot ?spot2 - narrow)
    :precondition (and
      (isAgentAtSpot ?a ?spot1)
      (reachable ?spot2 ?a)
      (path ?spot1 ?spot2)
      (forall (?a2 - robot)
        (not (isAgentAtSpot ?a2 ?spot2)))
      (forall (?a2 - robot ?spot3 - spot)
        (not (constrainedMove1 ?a2 ?spot3 ?spot2))))
    :effect (and
      (not (isAgentAtSpot ?a ?spot1))
      (isAgentAtSpot ?a ?spot2)))

  ;; Follow a robot that moves away, if nobody else follows it, and if it does not come the other way.
  (:action constrainedMove2
    :agent ?a - robot
    :parameters (?spot1 - spot ?spot2 - narrow)
    :precondition (and
      (isAgentAtSpot ?a ?spot1)
      (reachable ?spot2 ?a)
      (path ?spot1 ?spot2)
      (exists (?a2 - robot)
        (and
          (isAgentAtSpot ?a2 ?spot2)
          (or
            (exists (?spot3 - open)
              (standardMove ?a2 ?spot2 ?spot3))
            (exists (?spot3 - narrow)
              (or
                (constrainedMove1 ?a2 ?spot2 ?spot3)
                (constrainedMove2 ?a2 ?spot2 ?spot3))))
          (not (constrainedMove2 ?a2 ?spot2 ?spot1))))
      (forall (?a2 - robot ?spot3 - spot)
        (not (constrainedMove2 ?a2 ?spot3 ?spot2))))
    :effect (and
      (not (isAgentAtSpot ?a ?spot1))
      (isAgentAtSpot ?a ?spot2))))
