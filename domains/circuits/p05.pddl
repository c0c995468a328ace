;; Twelve nodes, a plant in one corner and a dam in the opposite one, three broken lines.
;; Both the hospital and the clinic need current whenever the crew sets out.
;;
;;   plant   =a1= mill     =a2= market =a3= clinic
;;     =                          x           -
;;     d1                         d3          d4
;;     =                          x           -
;;   harbour -b1- abbey    xb2x school =b3= castle
;;     x            =                         =
;;     e1           e2                        e4
;;     x            =                         =
;;   farm         hospital =c2= inn    =c3= dam
(define (problem circuits-p05)
  (:domain circuits)
  (:objects
    plant mill market clinic harbour abbey school castle farm hospital inn dam - node
    a1 a2 a3 b1 b2 b3 c2 c3 d1 d3 d4 e1 e2 e4 - line)
  (:init
    (feeds plant) (feeds dam) (critical clinic) (critical hospital)
    (joins a1 plant mill) (joins a1 mill plant) (closed a1)
    (joins a2 mill market) (joins a2 market mill) (closed a2)
    (joins a3 market clinic) (joins a3 clinic market) (closed a3)
    (joins b1 harbour abbey) (joins b1 abbey harbour)
    (joins b2 abbey school) (joins b2 school abbey) (broken b2)
    (joins b3 school castle) (joins b3 castle school) (closed b3)
    (joins c2 hospital inn) (joins c2 inn hospital) (closed c2)
    (joins c3 inn dam) (joins c3 dam inn) (closed c3)
    (joins d1 plant harbour) (joins d1 harbour plant) (closed d1)
    (joins d3 market school) (joins d3 school market) (broken d3)
    (joins d4 clinic castle) (joins d4 castle clinic)
    (joins e1 harbour farm) (joins e1 farm harbour) (broken e1)
    (joins e2 abbey hospital) (joins e2 hospital abbey) (closed e2)
    (joins e4 castle dam) (joins e4 dam castle) (closed e4))
  (:goal
    (and
      (powered mill)
      (powered market)
      (powered clinic)
      (powered harbour)
      (powered abbey)
      (powered school)
      (powered castle)
      (powered farm)
      (powered hospital)
      (powered inn)
      (not (broken b2))
      (not (broken d3))
      (not (broken e1)))))
