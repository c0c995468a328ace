;; As p02, but the mill also feeds the hospital, which needs the way round the harbour meanwhile.
;;
;;   plant  =north= mill xsouthx town
;;     -              =
;;    quay           ward
;;     -              =
;;   harbour -pier- hospital
(define (problem circuits-p03)
  (:domain circuits)
  (:objects
    plant mill town harbour hospital - node
    north south ward quay pier - line)
  (:init
    (feeds plant) (critical hospital)
    (joins north plant mill) (joins north mill plant) (closed north)
    (joins south mill town) (joins south town mill) (broken south)
    (joins ward mill hospital) (joins ward hospital mill) (closed ward)
    (joins quay plant harbour) (joins quay harbour plant)
    (joins pier harbour hospital) (joins pier hospital harbour))
  (:goal
    (and
      (powered mill)
      (powered town)
      (powered hospital))))
