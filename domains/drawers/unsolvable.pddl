;; As p02, but the chair is not known to be light, so the robot cannot push it:
;; nothing makes `(clear pinkDrawer)` true, the drawer stays closed and the plate has nowhere to go.
;; It is kept for questions of the kind "what would have to be different?";
;; one answer is `(clear pinkDrawer)`, as in the thesis, section 3.2.3.
(define (problem drawers-unsolvable)
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
    (stands chair1 pinkDrawer)
    (clear window)
    (way pinkDrawer window) (way window pinkDrawer))
  (:goal (inside redPlate pinkDrawer)))
