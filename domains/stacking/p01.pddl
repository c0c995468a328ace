;; The smallest stack: the red cube goes on the blue one.
(define (problem stacking-p01)
  (:domain stacking)
  (:objects red blue - cube)
  (:init
    (handClear)
    (onTable red) (clear red)
    (onTable blue) (clear blue))
  (:goal (onTop red blue)))
