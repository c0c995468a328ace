;; One tower of eight is turned upside down.
(define (problem stacking-p04)
  (:domain stacking)
  (:objects c1 c2 c3 c4 c5 c6 c7 c8 - cube)
  (:init
    (handClear)
    (onTable c8)
    (onTop c7 c8) (onTop c6 c7) (onTop c5 c6) (onTop c4 c5)
    (onTop c3 c4) (onTop c2 c3) (onTop c1 c2)
    (clear c1))
  (:goal
    (and
      (onTop c8 c7) (onTop c7 c6) (onTop c6 c5) (onTop c5 c4)
      (onTop c4 c3) (onTop c3 c2) (onTop c2 c1))))
