; expect: W0702 at 14:10-14:46
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
  (:goal (and (at liner gate) (at tea north))))
