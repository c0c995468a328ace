;; Four chambers, four colours: the yellow door is in the second chamber, its key in the last.
;; The red key and the green one must end where they lay.
;;
;; The map: @ robot, * goal, # wall, a capital a door, its small letter the key;
;; cell cX-Y is column X of row Y.
;;   r . # . g
;;   . . B . .
;;   . @ # . .
;;   R # # # G
;;   . . # . .
;;   b . # . y
;;   # Y # # #
;;   . . . . *
(define (problem keys-p05)
  (:domain keys)
  (:objects
    c1-1 c2-1 c4-1 c5-1 - cell
    c1-2 c2-2 c3-2 c4-2 c5-2 - cell
    c1-3 c2-3 c4-3 c5-3 - cell
    c1-4 c5-4 - cell
    c1-5 c2-5 c4-5 c5-5 - cell
    c1-6 c2-6 c4-6 c5-6 - cell
    c2-7 - cell
    c1-8 c2-8 c3-8 c4-8 c5-8 - cell
    red green blue yellow - colour
    red-key green-key blue-key yellow-key - key)
  (:init
    (at c2-3) (handClear)
    (lies red-key c1-1) (painted red-key red)
    (lies green-key c5-1) (painted green-key green)
    (lies blue-key c1-6) (painted blue-key blue)
    (lies yellow-key c5-6) (painted yellow-key yellow)
    (locked c3-2 blue)
    (locked c1-4 red)
    (locked c5-4 green)
    (locked c2-7 yellow)
    (open c1-1) (open c2-1) (open c4-1) (open c5-1)
    (open c1-2) (open c2-2) (open c4-2) (open c5-2)
    (open c1-3) (open c2-3) (open c4-3) (open c5-3)
    (open c1-5) (open c2-5) (open c4-5) (open c5-5)
    (open c1-6) (open c2-6) (open c4-6) (open c5-6)
    (open c1-8) (open c2-8) (open c3-8) (open c4-8) (open c5-8)
    (beside c1-1 c2-1) (beside c2-1 c1-1) (beside c1-1 c1-2) (beside c1-2 c1-1)
    (beside c2-1 c2-2) (beside c2-2 c2-1)
    (beside c4-1 c5-1) (beside c5-1 c4-1) (beside c4-1 c4-2) (beside c4-2 c4-1)
    (beside c5-1 c5-2) (beside c5-2 c5-1)
    (beside c1-2 c2-2) (beside c2-2 c1-2) (beside c1-2 c1-3) (beside c1-3 c1-2)
    (beside c2-2 c3-2) (beside c3-2 c2-2) (beside c2-2 c2-3) (beside c2-3 c2-2)
    (beside c3-2 c4-2) (beside c4-2 c3-2)
    (beside c4-2 c5-2) (beside c5-2 c4-2) (beside c4-2 c4-3) (beside c4-3 c4-2)
    (beside c5-2 c5-3) (beside c5-3 c5-2)
    (beside c1-3 c2-3) (beside c2-3 c1-3) (beside c1-3 c1-4) (beside c1-4 c1-3)
    (beside c4-3 c5-3) (beside c5-3 c4-3)
    (beside c5-3 c5-4) (beside c5-4 c5-3)
    (beside c1-4 c1-5) (beside c1-5 c1-4)
    (beside c5-4 c5-5) (beside c5-5 c5-4)
    (beside c1-5 c2-5) (beside c2-5 c1-5) (beside c1-5 c1-6) (beside c1-6 c1-5)
    (beside c2-5 c2-6) (beside c2-6 c2-5)
    (beside c4-5 c5-5) (beside c5-5 c4-5) (beside c4-5 c4-6) (beside c4-6 c4-5)
    (beside c5-5 c5-6) (beside c5-6 c5-5)
    (beside c1-6 c2-6) (beside c2-6 c1-6)
    (beside c2-6 c2-7) (beside c2-7 c2-6)
    (beside c4-6 c5-6) (beside c5-6 c4-6)
    (beside c2-7 c2-8) (beside c2-8 c2-7)
    (beside c1-8 c2-8) (beside c2-8 c1-8)
    (beside c2-8 c3-8) (beside c3-8 c2-8)
    (beside c3-8 c4-8) (beside c4-8 c3-8)
    (beside c4-8 c5-8) (beside c5-8 c4-8))
  (:goal
    (and
      (at c5-8)
      (lies red-key c1-1)
      (lies green-key c5-1))))
