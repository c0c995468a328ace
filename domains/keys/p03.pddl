;; Two doors in a row: the key of the second lies behind the first.
;;
;; The map: @ robot, * goal, # wall, a capital a door, its small letter the key;
;; cell cX-Y is column X of row Y.
;;   @ . . # * .
;;   . # . # . .
;;   r # R # B #
;;   . # . b . .
;;   . # # # # #
(define (problem keys-p03)
  (:domain keys)
  (:objects
    c1-1 c2-1 c3-1 c5-1 c6-1 - cell
    c1-2 c3-2 c5-2 c6-2 - cell
    c1-3 c3-3 c5-3 - cell
    c1-4 c3-4 c4-4 c5-4 c6-4 - cell
    c1-5 - cell
    red blue - colour
    red-key blue-key - key)
  (:init
    (at c1-1) (handClear)
    (lies red-key c1-3) (painted red-key red)
    (lies blue-key c4-4) (painted blue-key blue)
    (locked c3-3 red)
    (locked c5-3 blue)
    (open c1-1) (open c2-1) (open c3-1) (open c5-1) (open c6-1)
    (open c1-2) (open c3-2) (open c5-2) (open c6-2)
    (open c1-3)
    (open c1-4) (open c3-4) (open c4-4) (open c5-4) (open c6-4)
    (open c1-5)
    (beside c1-1 c2-1) (beside c2-1 c1-1) (beside c1-1 c1-2) (beside c1-2 c1-1)
    (beside c2-1 c3-1) (beside c3-1 c2-1)
    (beside c3-1 c3-2) (beside c3-2 c3-1)
    (beside c5-1 c6-1) (beside c6-1 c5-1) (beside c5-1 c5-2) (beside c5-2 c5-1)
    (beside c6-1 c6-2) (beside c6-2 c6-1)
    (beside c1-2 c1-3) (beside c1-3 c1-2)
    (beside c3-2 c3-3) (beside c3-3 c3-2)
    (beside c5-2 c6-2) (beside c6-2 c5-2) (beside c5-2 c5-3) (beside c5-3 c5-2)
    (beside c1-3 c1-4) (beside c1-4 c1-3)
    (beside c3-3 c3-4) (beside c3-4 c3-3)
    (beside c5-3 c5-4) (beside c5-4 c5-3)
    (beside c1-4 c1-5) (beside c1-5 c1-4)
    (beside c3-4 c4-4) (beside c4-4 c3-4)
    (beside c4-4 c5-4) (beside c5-4 c4-4)
    (beside c5-4 c6-4) (beside c6-4 c5-4))
  (:goal (at c5-1)))
