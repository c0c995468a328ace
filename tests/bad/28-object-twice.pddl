; expect: E0104 at 8:14-8:17
; with: good/domain.pddl
(define (problem monday)
  (:domain harbour)
  (:objects
    liner - ship
    left right - crane
    tea rice tea - container
    north south - berth)
  (:init
    (at liner gate) (at left north) (at right south) (broken right)
    (at tea north) (at rice north)
    (channel gate north) (channel north south) (channel south gate))
  (:goal (and (on tea liner) (at liner south))))
