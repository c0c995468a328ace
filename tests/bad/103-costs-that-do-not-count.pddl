; expect: W0707 at 3:18-3:25
; with: good/cost-domain.pddl
(define (problem tuesday)
  (:domain harbour)
  (:objects liner - ship north south - berth)
  (:init
    (at liner north) (channel north south)
    (= (miles north south) 12) (= (total-cost) 0))
  (:goal (at liner south)))
