;; The tower red-blue-green must be rebuilt as green-red-blue, read from the top:
;; the green cube has to come out from under both others.
(define (problem stacking-p02)
  (:domain stacking)
  (:objects red blue green - cube)
  (:init
    (handClear)
    (onTable green) (onTop blue green) (onTop red blue) (clear red))
  (:goal (and (onTop green red) (onTop red blue))))
