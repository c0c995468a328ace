;; Two robots in a corridor change places. One steps aside into the niche while the other follows it, and then goes on.
;; shortest joint plan: 2 steps
(define (problem swap)
  (:domain moves)
  (:objects
    slim wide - robot
    left right - narrow
    niche - open)
  (:init
    (isAgentAtSpot slim left) (isAgentAtSpot wide right)
    (reachable left slim) (reachable right slim) (reachable niche slim)
    (reachable left wide) (reachable right wide)
    (path left right) (path right left)
    (path left niche) (path niche left)
    (path right niche) (path niche right))
  (:goal
    (and
      (isAgentAtSpot slim right)
      (isAgentAtSpot wide left))))
