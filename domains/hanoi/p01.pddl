;; Two cubes move from the left spot to the right one.
(define (problem hanoi-p01)
  (:domain hanoi)
  (:objects
    small large - cube
    left middle right - spot)
  (:init
    (smaller small large) (smaller small left) (smaller small middle) (smaller small right)
    (smaller large left) (smaller large middle) (smaller large right)
    (onTop large left) (onTop small large) (clear small)
    (clear middle)
    (clear right))
  (:goal
    (and
      (onTop large right)
      (onTop small large))))
