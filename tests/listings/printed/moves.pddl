(:action standardMove
  :agent ?a – agent
  :parameters (?spot1 – spot ?spot2 – spot)
  :precondition (and
    (isAgentAtSpot ?a ?spot1) ; agent ?a is at ?spot1
    (reachable ?spot2 ?a)) ; ?spot2 is reachable by agent ?a
  :effect (and
    not(isAgentAtSpot ?a ?spot1)
    (isAgentAtSpot ?a ?spot2)))

(:action constrainedMove1
  :agent ?a – agent
  :parameters (?spot1 – spot ?spot2 – spot)
  :precondition (and
    (isAgentAtSpot ?a ?spot1)
    (reachable ?spot2 ?a))
  (forall ?a2 – agent (and
    not(isAgentAtSpot ?a2 ?spot2) ; no other agents are at
    ?spot2
    (forall ?spot3 – spot ; no other agents are moving towards
    ?spot2
    not(constrainedMove1(?a2 ?spot3 ?spot2))))))
  :effect (and
    not(isAgentAtSpot ?a ?spot1)
    (isAgentAtSpot ?a ?spot2)))

(:action constrainedMove2
  :agent ?a – agent
  :precondition (and
    (isAgentAtSpot ?a ?spot1)
    (reachable ?spot2 ?a)
    (exists ?a2 – agent (and
      (isAgentAtSpot ?a2 ?spot2)
      (exists ?spot3 – spot
        (constrainedMove1(?a2 ?spot2 ?spot3)))))) ; there is
      an agent ?a2 at ?spot2 that moves away from ?spot2
    :effect (and
    not (isAgentAtSpot ?a ?spot1)
    (isAgentAtSpot ?a ?spot2)))
