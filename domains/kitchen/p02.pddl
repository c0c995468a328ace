;; The hand is at a glass that stays where it is, and at the end the hand must be away from it:
;; reaching for the spoon does that, by its conditional effect.
(define (problem kitchen-p02)
  (:domain kitchen)
  (:objects
    r1 - robot
    t1 t2 - table
    d1 - drawer
    g1 - glass
    sp1 - spoon)
  (:init
    (handClear r1)
    (onTable g1 t1) (graspable g1 r1)
    (onTable sp1 t2))
  (:goal
    (and
      (handClear r1)
      (onTable g1 t1)
      (not (graspable g1 r1))
      (insideDrawer sp1 d1)
      (not (graspable sp1 r1)))))
