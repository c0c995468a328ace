;; Two things change drawers, a third comes out; two chairs and one free corner stand in a row of four places:
;;
;;   window - pinkDrawer - blueDrawer - greyDrawer
;;
;; The chairs cannot pass each other, and both stand before drawers that are needed.
(define (problem drawers-p04)
  (:domain drawers)
  (:objects
    redPlate greenPlate spoon - item
    pinkDrawer blueDrawer greyDrawer - drawer
    window - corner
    table1 - table
    chair1 chair2 - chair)
  (:init
    (handClear)
    (inside redPlate greyDrawer)
    (inside greenPlate pinkDrawer)
    (inside spoon blueDrawer)
    (light chair1) (light chair2)
    (stands chair1 pinkDrawer) (stands chair2 blueDrawer)
    (clear window) (clear greyDrawer)
    (way window pinkDrawer) (way pinkDrawer window)
    (way pinkDrawer blueDrawer) (way blueDrawer pinkDrawer)
    (way blueDrawer greyDrawer) (way greyDrawer blueDrawer))
  (:goal
    (and
      (inside redPlate pinkDrawer)
      (inside greenPlate greyDrawer)
      (onTable spoon table1)
      (not (open pinkDrawer)) (not (open blueDrawer)) (not (open greyDrawer)))))
