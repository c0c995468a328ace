;; Two trucks share four packages; the van takes one at a time, the lorry two.
;; The harbour is far from everything, so only one of them should go there.
(define (problem delivery-p03)
  (:domain delivery)
  (:objects
    mill market harbour farm school - town
    van lorry - truck
    flour apples fish books - package
    room0 room1 room2 - room)
  (:init
    (= (total-cost) 0)
    (more room0 room1)
    (more room1 room2)
    ; roads, the same length both ways
    (road mill market) (= (length mill market) 3)
    (road market mill) (= (length market mill) 3)
    (road market school) (= (length market school) 2)
    (road school market) (= (length school market) 2)
    (road market farm) (= (length market farm) 6)
    (road farm market) (= (length farm market) 6)
    (road farm school) (= (length farm school) 5)
    (road school farm) (= (length school farm) 5)
    (road harbour market) (= (length harbour market) 12)
    (road market harbour) (= (length market harbour) 12)
    (road harbour mill) (= (length harbour mill) 10)
    (road mill harbour) (= (length mill harbour) 10)
    ; trucks
    (at van school) (free van room1)
    (at lorry farm) (free lorry room2)
    ; packages
    (at flour mill)
    (at apples farm)
    (at fish harbour)
    (at books school))
  (:goal
    (and
      (at flour school)
      (at apples school)
      (at fish market)
      (at books farm)))
  (:metric minimize (total-cost)))
