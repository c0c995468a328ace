(define (problem tuesday)
  (:domain harbour)
  (:objects liner - ship north south - berth)
  (:init
    (at liner north) (channel north south)
    (= (miles north south) 12) (= (total-cost) 0))
  (:goal (at liner south))
  (:metric minimize (total-cost)))
