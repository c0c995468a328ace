;; The table is laid for two while the last meal's things are put away, by one robot.
;; Its hand ends at the bowl, ready to serve.
(define (problem kitchen-p05)
  (:domain kitchen)
  (:objects
    r1 - robot
    t1 t2 - table
    d1 - drawer
    f1 f2 - fork
    k1 k2 - knife
    p1 p2 - plate
    b1 - bowl
    g1 - glass)
  (:init
    (handClear r1)
    (insideDrawer f1 d1) (insideDrawer f2 d1)
    (insideDrawer k1 d1) (insideDrawer k2 d1)
    (insideDrawer p1 d1) (insideDrawer p2 d1)
    (onTable b1 t1) (onTable g1 t2))
  (:goal
    (and
      (onTable f1 t1) (onTable f2 t1)
      (onTable k1 t1) (onTable k2 t1)
      (onTable p1 t1) (onTable p2 t1)
      (onTable b1 t2) (graspable b1 r1)
      (insideDrawer g1 d1))))
