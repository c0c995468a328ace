; expect: W0701 at 14:47-14:68
; with: good/domain.pddl
(define (problem monday)
  (:domain harbour)
  (:objects
    liner - ship
    left right - crane
    tea rice - container
    north south - berth)
  (:init
    (at liner gate) (at left north) (at right south) (broken right)
    (at tea north) (at rice north)
    (channel gate north) (channel north south) (channel south gate))
  (:goal (and (on tea liner) (at liner south) (channel south north))))
