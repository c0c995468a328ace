; expect: W0709 at 3:18-3:24
; with: good/domain.pddl
(define (problem monday)
  (:domain harbour)
  (:objects
    liner - ship
    tea rice - container
    north south - berth)
  (:init
    (at liner gate) 
    (at tea north) (at rice north)
    (channel gate north) (channel north south) (channel south gate))
  (:goal (and (at liner south))))
