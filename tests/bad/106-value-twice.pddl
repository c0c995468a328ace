; expect: E0104 at 8:51-8:77
; with: good/cost-domain.pddl
(define (problem tuesday)
  (:domain harbour)
  (:objects liner - ship north south - berth)
  (:init
    (at liner north) (channel north south)
    (= (miles north south) 12) (= (total-cost) 0) (= (miles north south) 13))
  (:goal (at liner south))
  (:metric minimize (total-cost)))
