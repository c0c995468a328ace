;; The broken line hangs on the mill, which must be cut off while the crew works.
;;
;;   plant =north= mill xsouthx town
(define (problem circuits-p02)
  (:domain circuits)
  (:objects
    plant mill town - node
    north south - line)
  (:init
    (feeds plant)
    (joins north plant mill) (joins north mill plant) (closed north)
    (joins south mill town) (joins south town mill) (broken south))
  (:goal
    (and
      (powered mill)
      (powered town))))
