;; A ring of eight towns with two shortcuts, two trucks, five packages.
(define (problem delivery-p05)
  (:domain delivery)
  (:objects
    mill market school castle abbey inn farm harbour - town
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
    (road school castle) (= (length school castle) 7)
    (road castle school) (= (length castle school) 7)
    (road castle abbey) (= (length castle abbey) 3)
    (road abbey castle) (= (length abbey castle) 3)
    (road abbey inn) (= (length abbey inn) 2)
    (road inn abbey) (= (length inn abbey) 2)
    (road inn farm) (= (length inn farm) 6)
    (road farm inn) (= (length farm inn) 6)
    (road farm harbour) (= (length farm harbour) 4)
    (road harbour farm) (= (length harbour farm) 4)
    (road harbour mill) (= (length harbour mill) 8)
    (road mill harbour) (= (length mill harbour) 8)
    (road market abbey) (= (length market abbey) 9)
    (road abbey market) (= (length abbey market) 9)
    (road school farm) (= (length school farm) 11)
    (road farm school) (= (length farm school) 11)
    ; trucks
    (at van mill) (free van room2)
    (at lorry castle) (free lorry room3)
    ; packages
    (at flour mill)
    (at cheese farm)
    (at books school)
    (at candles abbey)
    (at ale inn))
  (:goal
    (and
      (at flour abbey)
      (at cheese inn)
      (at books castle)
      (at candles market)
      (at ale harbour)))
  (:metric minimize (total-cost)))
