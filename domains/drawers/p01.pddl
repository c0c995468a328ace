;; The red plate goes into the pink drawer, which is closed.
(define (problem drawers-p01)
  (:domain drawers)
  (:objects
    redPlate - item
    pinkDrawer - drawer
    table1 - table)
  (:init
    (handClear)
    (onTable redPlate table1)
    (clear pinkDrawer))
  (:goal (inside redPlate pinkDrawer)))
