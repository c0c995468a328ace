;; The table is laid for one out of the drawers by two robots, and a used glass is cleared away.
;; Both hands are at the plate; once one has picked it, it is graspable for neither.
(define (problem kitchen-p04)
  (:domain kitchen)
  (:objects
    r1 r2 - robot
    t1 t2 - table
    d1 d2 - drawer
    f1 - fork
    k1 - knife
    p1 - plate
    g1 - glass)
  (:init
    (handClear r1) (handClear r2)
    (insideDrawer f1 d1) (insideDrawer k1 d1)
    (insideDrawer p1 d2)
    (onTable g1 t1)
    (graspable p1 r1) (graspable p1 r2))
  (:goal
    (and
      (onTable f1 t1) (onTable k1 t1)
      (onTable p1 t1)
      (insideDrawer g1 d2)
      (handClear r1) (handClear r2)
      (not (graspable p1 r1)) (not (graspable p1 r2)))))
