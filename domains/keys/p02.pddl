;; The key lies away from the door.
;;
;; The map: @ robot, * goal, # wall, a capital a door, its small letter the key;
;; cell cX-Y is column X of row Y.
;;   @ . . .
;;   . # # R
;;   r # * .
(define (problem keys-p02)
  (:domain keys)
  (:objects
    c1-1 c2-1 c3-1 c4-1 - cell
    c1-2 c4-2 - cell
    c1-3 c3-3 c4-3 - cell
    red - colour
    red-key - key)
  (:init
    (at c1-1) (handClear)
    (lies red-key c1-3) (painted red-key red)
    (locked c4-2 red)
    (open c1-1) (open c2-1) (open c3-1) (open c4-1)
    (open c1-2)
    (open c1-3) (open c3-3) (open c4-3)
    (beside c1-1 c2-1) (beside c2-1 c1-1) (beside c1-1 c1-2) (beside c1-2 c1-1)
    (beside c2-1 c3-1) (beside c3-1 c2-1)
    (beside c3-1 c4-1) (beside c4-1 c3-1)
    (beside c4-1 c4-2) (beside c4-2 c4-1)
    (beside c1-2 c1-3) (beside c1-3 c1-2)
    (beside c4-2 c4-3) (beside c4-3 c4-2)
    (beside c3-3 c4-3) (beside c4-3 c3-3))
  (:goal (at c3-3)))
