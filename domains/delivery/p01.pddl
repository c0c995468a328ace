;; One package, one truck, and a short way round: the direct road is the longer one.
(define (problem delivery-p01)
  (:domain delivery)
  (:objects
    mill market harbour - town
    van - truck
    parcel - package
    room0 room1 - room)
  (:init
    (= (total-cost) 0)
    (more room0 room1)
    ; roads, the same length both ways
    (road mill harbour) (= (length mill harbour) 9)
    (road harbour mill) (= (length harbour mill) 9)
    (road mill market) (= (length mill market) 3)
    (road market mill) (= (length market mill) 3)
    (road market harbour) (= (length market harbour) 4)
    (road harbour market) (= (length harbour market) 4)
    ; trucks
    (at van mill) (free van room1)
    ; packages
    (at parcel mill))
  (:goal (at parcel harbour))
  (:metric minimize (total-cost)))
