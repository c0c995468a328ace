;; Two carts bring two crates from the store to the gate. In the end each cart stands in the garage: that is a goal of its own for every cart.
;; Both carts at work are faster, at a cost of 26; one cart that drives twice is cheaper.
;; shortest joint plan: 6 steps
;; cheapest joint plan: 25
(define (problem two-carts)
  (:domain warehouse)
  (:objects
    red blue - cart
    inner outer - crane
    tea coffee - crate
    store gate garage - place)
  (:init
    (at red garage) (at blue garage)
    (at inner store) (at outer gate)
    (empty red) (empty blue)
    (stored tea store) (stored coffee store)
    (road garage store) (road store garage)
    (road store gate) (road gate store)
    (road gate garage) (road garage gate)
    (= (distance garage store) 2) (= (distance store garage) 2)
    (= (distance store gate) 5) (= (distance gate store) 5)
    (= (distance gate garage) 4) (= (distance garage gate) 4)
    (= (total-cost) 0))
  (:goal
    :condition (and
      (stored tea gate)
      (stored coffee gate)))
  (:goal
    :agent ?cart - cart
    :condition (at ?cart garage))
  (:metric minimize (total-cost)))
