; expect: E0103 at 12:24-12:28
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
    (at tea north) (at rise north)
    (channel gate north) (channel north south) (channel south gate))
  (:goal (and (on tea liner) (at liner south))))
