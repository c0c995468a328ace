(define (problem pickandplaceproblem)
(:domain kitchen)

;; Object definitions
(:objects
  r1 - robot
  d1 d2 d3 - drawer
  t1 t2 t3 - table
  f1 f2 f3 f4 - fork
  k1 k2 k3 k4 - knife
  sp1 sp2 - spoon
  p1 p2 - plate
  b1 - bowl
  g1 g2 g3 - glass
)

;; Initial state
(:init
  ;; Objects initially on tables
  (onTable f1 t1)
  (onTable f2 t2)
  (onTable k1 t3)
  (onTable sp1 t1)
  (onTable p1 t2)
  (onTable g1 t3)

  ;; Robot hand state
  (handClear r1)
)

;; Goal state
(:goal
  (and
    (handClear r1)
    (not (inhand f1 r1))
    (not (inhand f2 r1))
    (not (inhand k1 r1))
    (not (inhand sp1 r1))
    (not (graspable f1 r1))
    (not (graspable f2 r1))
    (not (graspable k1 r1))
    (not (graspable sp1 r1))

    ;; Objects that are moved from the tables into the
    ; drawers
    (insideDrawer f1 d1)
    (insideDrawer f2 d1)
    (insideDrawer k1 d2)
    (insideDrawer sp1 d3)
  )
)
)
