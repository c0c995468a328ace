;; One fork goes from the table into the drawer: reach, pick, put in.
(define (problem kitchen-p01)
  (:domain kitchen)
  (:objects
    r1 - robot
    t1 - table
    d1 - drawer
    f1 - fork)
  (:init
    (handClear r1)
    (onTable f1 t1))
  (:goal (insideDrawer f1 d1)))
