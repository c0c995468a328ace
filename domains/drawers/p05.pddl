;; A kitchen of six drawers along two walls, with three chairs:
;;
;;   window - pinkDrawer - blueDrawer - greyDrawer
;;     |                                    |
;;   door --- wideDrawer - tallDrawer - deepDrawer
;;
;; The chair in the corner by the door is too heavy to push and closes the ring there.
;; The other two stand before drawers that are needed and cannot pass each other.
(define (problem drawers-p05)
  (:domain drawers)
  (:objects
    redPlate greenPlate spoon fork bowl - item
    pinkDrawer blueDrawer greyDrawer wideDrawer tallDrawer deepDrawer - drawer
    window door - corner
    table1 - table
    chair1 chair2 chair3 - chair)
  (:init
    (handClear)
    (inside redPlate greyDrawer)
    (inside greenPlate pinkDrawer)
    (inside spoon wideDrawer)
    (onTable fork table1) (onTable bowl table1)
    (light chair1) (light chair2)
    (stands chair1 pinkDrawer) (stands chair2 wideDrawer) (stands chair3 door)
    (clear window) (clear blueDrawer) (clear greyDrawer) (clear tallDrawer) (clear deepDrawer)
    (way window pinkDrawer) (way pinkDrawer window)
    (way pinkDrawer blueDrawer) (way blueDrawer pinkDrawer)
    (way blueDrawer greyDrawer) (way greyDrawer blueDrawer)
    (way greyDrawer deepDrawer) (way deepDrawer greyDrawer)
    (way deepDrawer tallDrawer) (way tallDrawer deepDrawer)
    (way tallDrawer wideDrawer) (way wideDrawer tallDrawer)
    (way wideDrawer door) (way door wideDrawer)
    (way door window) (way window door))
  (:goal
    (and
      (inside redPlate pinkDrawer)
      (inside greenPlate wideDrawer)
      (inside bowl wideDrawer)
      (inside spoon tallDrawer)
      (inside fork tallDrawer)
      (not (open pinkDrawer)) (not (open greyDrawer))
      (not (open wideDrawer)) (not (open tallDrawer))
      (stands chair1 blueDrawer))))
