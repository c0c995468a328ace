;; Two packages lie on the way of one truck that can carry both.
(define (problem delivery-p02)
  (:domain delivery)
  (:objects
    mill market harbour farm - town
    van - truck
    flour apples - package
    room0 room1 room2 - room)
  (:init
    (= (total-cost) 0)
    (more room0 room1)
    (more room1 room2)
    ; roads, the same length both ways
    (road mill market) (= (length mill market) 3)
    (road market mill) (= (length market mill) 3)
    (road market harbour) (= (length market harbour) 4)
    (road harbour market) (= (length harbour market) 4)
    (road market farm) (= (length market farm) 6)
    (road farm market) (= (length farm market) 6)
    (road farm harbour) (= (length farm harbour) 5)
    (road harbour farm) (= (length harbour farm) 5)
    ; trucks
    (at van harbour) (free van room2)
    ; packages
    (at flour mill)
    (at apples farm))
  (:goal
    (and
      (at flour harbour)
      (at apples market)))
  (:metric minimize (total-cost)))
