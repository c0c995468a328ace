(define (problem left-arm)
  (:domain sorting)
  (:objects
    hall - place
    (:private left - arm cup1 - cup))
  (:init (at cup1 hall))
  (:goal (holds left cup1)))
