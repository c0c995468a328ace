;; A chair stands before the pink drawer and must be pushed into the corner first.
;; The hand has to be free for pushing and for opening, so the plate waits on the table.
(define (problem drawers-p02)
  (:domain drawers)
  (:objects
    redPlate - item
    pinkDrawer - drawer
    window - corner
    table1 - table
    chair1 - chair)
  (:init
    (handClear)
    (onTable redPlate table1)
    (light chair1)
    (stands chair1 pinkDrawer)
    (clear window)
    (way pinkDrawer window) (way window pinkDrawer))
  (:goal (inside redPlate pinkDrawer)))
