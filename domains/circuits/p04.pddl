;; Two broken lines meet at the abbey. The hospital is fed the long way round, over the mill;
;; fed over the harbour instead, it would send current back to the school and the market.
;;
;;   plant   =a1= mill     =a2= market
;;     -            x             =
;;     d1           d2            d3
;;     -            x             =
;;   harbour      abbey    xb2x school
;;     -            =             =
;;     e1           e2            e3
;;     -            =             =
;;   farm    -c1- hospital =c2= inn
(define (problem circuits-p04)
  (:domain circuits)
  (:objects
    plant mill market harbour abbey school farm hospital inn - node
    a1 a2 b2 c1 c2 d1 d2 d3 e1 e2 e3 - line)
  (:init
    (feeds plant) (critical hospital)
    (joins a1 plant mill) (joins a1 mill plant) (closed a1)
    (joins a2 mill market) (joins a2 market mill) (closed a2)
    (joins b2 abbey school) (joins b2 school abbey) (broken b2)
    (joins c1 farm hospital) (joins c1 hospital farm)
    (joins c2 hospital inn) (joins c2 inn hospital) (closed c2)
    (joins d1 plant harbour) (joins d1 harbour plant)
    (joins d2 mill abbey) (joins d2 abbey mill) (broken d2)
    (joins d3 market school) (joins d3 school market) (closed d3)
    (joins e1 harbour farm) (joins e1 farm harbour)
    (joins e2 abbey hospital) (joins e2 hospital abbey) (closed e2)
    (joins e3 school inn) (joins e3 inn school) (closed e3))
  (:goal
    (and
      (powered mill)
      (powered market)
      (powered harbour)
      (powered abbey)
      (powered school)
      (powered farm)
      (powered hospital)
      (powered inn)
      (not (broken b2))
      (not (broken d2)))))
