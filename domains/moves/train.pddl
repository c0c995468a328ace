;; Three robots pass a corridor of three narrow spots: they enter one after the other, and then all move at once.
;; The last one does not fit into the hall and stays at its door.
;; shortest joint plan: 5 steps
(define (problem train)
  (:domain moves)
  (:objects
    a b wide - robot
    yard hall - open
    east middle west - narrow)
  (:init
    (isAgentAtSpot a yard) (isAgentAtSpot b yard) (isAgentAtSpot wide yard)
    (reachable yard a) (reachable east a) (reachable middle a)
    (reachable west a) (reachable hall a)
    (reachable yard b) (reachable east b) (reachable middle b)
    (reachable west b) (reachable hall b)
    (reachable yard wide) (reachable east wide) (reachable middle wide)
    (reachable west wide)
    (path yard east) (path east middle) (path middle west) (path west hall)
    (path east yard) (path middle east) (path west middle) (path hall west))
  (:goal
    (and
      (isAgentAtSpot a hall)
      (isAgentAtSpot b hall)
      (isAgentAtSpot wide west))))
