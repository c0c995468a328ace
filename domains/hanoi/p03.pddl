;; Five cubes, three spots: 2^5 - 1 = 31 moves.
(define (problem hanoi-p03)
  (:domain hanoi)
  (:objects
    c1 c2 c3 c4 c5 - cube
    left middle right - spot)
  (:init
    (smaller c1 c2) (smaller c1 c3) (smaller c1 c4) (smaller c1 c5) (smaller c1 left) (smaller c1 middle) (smaller c1 right)
    (smaller c2 c3) (smaller c2 c4) (smaller c2 c5) (smaller c2 left) (smaller c2 middle) (smaller c2 right)
    (smaller c3 c4) (smaller c3 c5) (smaller c3 left) (smaller c3 middle) (smaller c3 right)
    (smaller c4 c5) (smaller c4 left) (smaller c4 middle) (smaller c4 right)
    (smaller c5 left) (smaller c5 middle) (smaller c5 right)
    (onTop c5 left) (onTop c4 c5) (onTop c3 c4) (onTop c2 c3) (onTop c1 c2) (clear c1)
    (clear middle)
    (clear right))
  (:goal
    (and
      (onTop c5 right)
      (onTop c4 c5)
      (onTop c3 c4)
      (onTop c2 c3)
      (onTop c1 c2))))
