;; Three chambers, each with the key of the next; at the end the red key must lie where it lay.
;;
;; The map: @ robot, * goal, # wall, a capital a door, its small letter the key;
;; cell cX-Y is column X of row Y.
;;   @ . . # b . .
;;   . r . R . . .
;;   . . . # # # B
;;   # # # # . . .
;;   . . . # . # .
;;   * . . G . . g
(define (problem keys-p04)
  (:domain keys)
  (:objects
    c1-1 c2-1 c3-1 c5-1 c6-1 c7-1 - cell
    c1-2 c2-2 c3-2 c4-2 c5-2 c6-2 c7-2 - cell
    c1-3 c2-3 c3-3 c7-3 - cell
    c5-4 c6-4 c7-4 - cell
    c1-5 c2-5 c3-5 c5-5 c7-5 - cell
    c1-6 c2-6 c3-6 c4-6 c5-6 c6-6 c7-6 - cell
    blue red green - colour
    blue-key red-key green-key - key)
  (:init
    (at c1-1) (handClear)
    (lies blue-key c5-1) (painted blue-key blue)
    (lies red-key c2-2) (painted red-key red)
    (lies green-key c7-6) (painted green-key green)
    (locked c4-2 red)
    (locked c7-3 blue)
    (locked c4-6 green)
    (open c1-1) (open c2-1) (open c3-1) (open c5-1) (open c6-1) (open c7-1)
    (open c1-2) (open c2-2) (open c3-2) (open c5-2) (open c6-2) (open c7-2)
    (open c1-3) (open c2-3) (open c3-3)
    (open c5-4) (open c6-4) (open c7-4)
    (open c1-5) (open c2-5) (open c3-5) (open c5-5) (open c7-5)
    (open c1-6) (open c2-6) (open c3-6) (open c5-6) (open c6-6) (open c7-6)
    (beside c1-1 c2-1) (beside c2-1 c1-1) (beside c1-1 c1-2) (beside c1-2 c1-1)
    (beside c2-1 c3-1) (beside c3-1 c2-1) (beside c2-1 c2-2) (beside c2-2 c2-1)
    (beside c3-1 c3-2) (beside c3-2 c3-1)
    (beside c5-1 c6-1) (beside c6-1 c5-1) (beside c5-1 c5-2) (beside c5-2 c5-1)
    (beside c6-1 c7-1) (beside c7-1 c6-1) (beside c6-1 c6-2) (beside c6-2 c6-1)
    (beside c7-1 c7-2) (beside c7-2 c7-1)
    (beside c1-2 c2-2) (beside c2-2 c1-2) (beside c1-2 c1-3) (beside c1-3 c1-2)
    (beside c2-2 c3-2) (beside c3-2 c2-2) (beside c2-2 c2-3) (beside c2-3 c2-2)
    (beside c3-2 c4-2) (beside c4-2 c3-2) (beside c3-2 c3-3) (beside c3-3 c3-2)
    (beside c4-2 c5-2) (beside c5-2 c4-2)
    (beside c5-2 c6-2) (beside c6-2 c5-2)
    (beside c6-2 c7-2) (beside c7-2 c6-2)
    (beside c7-2 c7-3) (beside c7-3 c7-2)
    (beside c1-3 c2-3) (beside c2-3 c1-3)
    (beside c2-3 c3-3) (beside c3-3 c2-3)
    (beside c7-3 c7-4) (beside c7-4 c7-3)
    (beside c5-4 c6-4) (beside c6-4 c5-4) (beside c5-4 c5-5) (beside c5-5 c5-4)
    (beside c6-4 c7-4) (beside c7-4 c6-4)
    (beside c7-4 c7-5) (beside c7-5 c7-4)
    (beside c1-5 c2-5) (beside c2-5 c1-5) (beside c1-5 c1-6) (beside c1-6 c1-5)
    (beside c2-5 c3-5) (beside c3-5 c2-5) (beside c2-5 c2-6) (beside c2-6 c2-5)
    (beside c3-5 c3-6) (beside c3-6 c3-5)
    (beside c5-5 c5-6) (beside c5-6 c5-5)
    (beside c7-5 c7-6) (beside c7-6 c7-5)
    (beside c1-6 c2-6) (beside c2-6 c1-6)
    (beside c2-6 c3-6) (beside c3-6 c2-6)
    (beside c3-6 c4-6) (beside c4-6 c3-6)
    (beside c4-6 c5-6) (beside c5-6 c4-6)
    (beside c5-6 c6-6) (beside c6-6 c5-6)
    (beside c6-6 c7-6) (beside c7-6 c6-6))
  (:goal
    (and
      (at c1-6)
      (lies red-key c2-2))))
