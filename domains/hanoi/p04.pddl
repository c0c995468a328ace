;; Six cubes that start spread over all spots are gathered on the right one.
(define (problem hanoi-p04)
  (:domain hanoi)
  (:objects
    c1 c2 c3 c4 c5 c6 - cube
    left middle right - spot)
  (:init
    (smaller c1 c2) (smaller c1 c3) (smaller c1 c4) (smaller c1 c5) (smaller c1 c6) (smaller c1 left) (smaller c1 middle) (smaller c1 right)
    (smaller c2 c3) (smaller c2 c4) (smaller c2 c5) (smaller c2 c6) (smaller c2 left) (smaller c2 middle) (smaller c2 right)
    (smaller c3 c4) (smaller c3 c5) (smaller c3 c6) (smaller c3 left) (smaller c3 middle) (smaller c3 right)
    (smaller c4 c5) (smaller c4 c6) (smaller c4 left) (smaller c4 middle) (smaller c4 right)
    (smaller c5 c6) (smaller c5 left) (smaller c5 middle) (smaller c5 right)
    (smaller c6 left) (smaller c6 middle) (smaller c6 right)
    (onTop c6 left) (onTop c3 c6) (clear c3)
    (onTop c5 middle) (onTop c2 c5) (clear c2)
    (onTop c4 right) (onTop c1 c4) (clear c1))
  (:goal
    (and
      (onTop c6 right)
      (onTop c5 c6)
      (onTop c4 c5)
      (onTop c3 c4)
      (onTop c2 c3)
      (onTop c1 c2))))
