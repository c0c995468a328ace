;; There is no corner: the chair always stands before one of the two drawers, and both must be filled and closed.
(define (problem drawers-p03)
  (:domain drawers)
  (:objects
    redPlate greenPlate spoon - item
    pinkDrawer blueDrawer - drawer
    table1 - table
    chair1 - chair)
  (:init
    (handClear)
    (onTable redPlate table1) (onTable greenPlate table1) (onTable spoon table1)
    (light chair1)
    (stands chair1 pinkDrawer)
    (clear blueDrawer)
    (way pinkDrawer blueDrawer) (way blueDrawer pinkDrawer))
  (:goal
    (and
      (inside redPlate pinkDrawer) (inside spoon pinkDrawer) (not (open pinkDrawer))
      (inside greenPlate blueDrawer) (not (open blueDrawer)))))
