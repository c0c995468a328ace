;; Three robots fill a ring of three narrow spots, and each is to be where the next one is: only all together can move.
;; Going out into the yard does not help, since no path leads back.
;; shortest joint plan: 1 step
(define (problem ring)
  (:domain moves)
  (:objects
    a b wide - robot
    north south east - narrow
    yard - open)
  (:init
    (isAgentAtSpot a north) (isAgentAtSpot b south) (isAgentAtSpot wide east)
    (reachable north a) (reachable south a) (reachable east a)
    (reachable yard a)
    (reachable north b) (reachable south b) (reachable east b)
    (reachable yard b)
    (reachable north wide) (reachable south wide) (reachable east wide)
    (path north south) (path south east) (path east north)
    (path south north) (path east south) (path north east)
    (path north yard))
  (:goal
    (and
      (isAgentAtSpot a south)
      (isAgentAtSpot b east)
      (isAgentAtSpot wide north))))
