; expect: E0502 at 8:28-8:34
; with: good/cost-domain.pddl
(define (problem tuesday)
  (:domain harbour)
  (:objects liner - ship north south - berth)
  (:init
    (at liner north) (channel north south)
    (= (miles north south) twelve) (= (total-cost) 0))
  (:goal (at liner south))
  (:metric minimize (total-cost)))
