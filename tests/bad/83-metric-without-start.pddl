; expect: W0501 at 10:21-10:33
; with: good/cost-domain.pddl
(define (problem tuesday)
  (:domain harbour)
  (:objects liner - ship north south - berth)
  (:init
    (at liner north) (channel north south)
    (= (miles north south) 12))
  (:goal (at liner south))
  (:metric minimize (total-cost)))
