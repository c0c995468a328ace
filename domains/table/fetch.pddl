;; The table fetches a block from another room, and a third robot is there already. It loads the block when the table has come.
;; shortest joint plan: 7 steps
(define (problem fetch)
  (:domain table)
  (:objects
    ann bob cid - robot
    left right - side
    red - block
    hall cellar - room)
  (:init
    (in ann hall) (in bob hall) (in cid cellar)
    (free ann) (free bob) (free cid)
    (stands hall)
    (onFloor red cellar))
  (:goal
    (and
      (onTable red)
      (stands hall)
      (not (up left))
      (not (up right)))))
