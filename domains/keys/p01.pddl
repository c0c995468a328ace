;; One door, one key on the way to it.
;;
;; The map: @ robot, * goal, # wall, a capital a door, its small letter the key;
;; cell cX-Y is column X of row Y.
;;   @ r R *
(define (problem keys-p01)
  (:domain keys)
  (:objects
    c1-1 c2-1 c3-1 c4-1 - cell
    red - colour
    red-key - key)
  (:init
    (at c1-1) (handClear)
    (lies red-key c2-1) (painted red-key red)
    (locked c3-1 red)
    (open c1-1) (open c2-1) (open c4-1)
    (beside c1-1 c2-1) (beside c2-1 c1-1)
    (beside c2-1 c3-1) (beside c3-1 c2-1)
    (beside c3-1 c4-1) (beside c4-1 c3-1))
  (:goal (at c4-1)))
