;; Two towers of three become two towers of another mixture.
(define (problem stacking-p03)
  (:domain stacking)
  (:objects red blue green yellow white black - cube)
  (:init
    (handClear)
    (onTable green) (onTop blue green) (onTop red blue) (clear red)
    (onTable black) (onTop white black) (onTop yellow white) (clear yellow))
  (:goal
    (and
      (onTop green white) (onTop white red)
      (onTop blue black) (onTop black yellow))))
