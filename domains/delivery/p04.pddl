;; Two regions joined by one long road, a truck in each, five packages.
;; The packages that cross the long road are worth gathering first.
(define (problem delivery-p04)
  (:domain delivery)
  (:objects
    mill market school castle abbey inn - town
    van lorry - truck
    flour cheese books candles ale - package
    room0 room1 room2 room3 - room)
  (:init
    (= (total-cost) 0)
    (more room0 room1)
    (more room1 room2)
    (more room2 room3)
    ; roads, the same length both ways
    (road mill market) (= (length mill market) 3)
    (road market mill) (= (length market mill) 3)
    (road market school) (= (length market school) 2)
    (road school market) (= (length school market) 2)
    (road mill school) (= (length mill school) 4)
    (road school mill) (= (length school mill) 4)
    (road castle abbey) (= (length castle abbey) 3)
    (road abbey castle) (= (length abbey castle) 3)
    (road abbey inn) (= (length abbey inn) 2)
    (road inn abbey) (= (length inn abbey) 2)
    (road castle inn) (= (length castle inn) 4)
    (road inn castle) (= (length inn castle) 4)
    (road market castle) (= (length market castle) 15)
    (road castle market) (= (length castle market) 15)
    ; trucks
    (at van mill) (free van room2)
    (at lorry inn) (free lorry room3)
    ; packages
    (at flour mill)
    (at cheese school)
    (at books school)
    (at candles abbey)
    (at ale inn))
  (:goal
    (and
      (at flour abbey)
      (at cheese inn)
      (at books castle)
      (at candles market)
      (at ale castle)))
  (:metric minimize (total-cost)))
