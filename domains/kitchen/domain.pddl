;; Kitchen: a robot moves cutlery and dishes between tables and drawers.
;;
;; The domain follows the kitchen of the thesis, section 3.1.3, where `reach`, `pick` and `put-in` are printed.
;; Mended here, because the printed text is not sound or not PDDL:
;; - The printed `:types` puts `object` below itself; what the robot handles is an `item` here.
;; - The printed `pick` leaves the item on its table, so that one item could be picked again and again;
;;   the formal `pick` of section 3.1.1.2 takes it off the table, and so does this one.
;; - The printed `:requirements` leaves out all but two of what the actions use.
;; - `put-on` and `take-out` are added, so that things come back out of the drawers.
;;   With them `reach` needs a twin for drawers, `reach-into`.

(define (domain kitchen)
  (:requirements :strips :typing :equality :negative-preconditions :conditional-effects)

  (:types
    robot table drawer item - object
    fork knife spoon plate bowl glass - item)

  (:predicates
    (onTable ?item - item ?table - table)           ; the item is on the table
    (insideDrawer ?item - item ?drawer - drawer)    ; the item is inside the drawer
    (inHand ?item - item ?robot - robot)            ; the robot holds the item
    (handClear ?robot - robot)                      ; the robot's hand is free
    (graspable ?item - item ?robot - robot))        ; the robot's hand is at the item

  ;; Move the hand to an item on a table.
  ;; The hand leaves whatever it was at, so every other item ceases to be graspable for this robot.
  (:action reach
    :parameters (?robot - robot ?item - item ?table - table)
    :precondition (and
      (handClear ?robot)
      (not (inHand ?item ?robot))
      (onTable ?item ?table))
    :effect (and
      (graspable ?item ?robot)
      (forall (?other - item)
        (when (not (= ?other ?item))
          (not (graspable ?other ?robot))))))

  ;; Move the hand to an item in a drawer.
  (:action reach-into
    :parameters (?robot - robot ?item - item ?drawer - drawer)
    :precondition (and
      (handClear ?robot)
      (not (inHand ?item ?robot))
      (insideDrawer ?item ?drawer))
    :effect (and
      (graspable ?item ?robot)
      (forall (?other - item)
        (when (not (= ?other ?item))
          (not (graspable ?other ?robot))))))

  ;; Close the hand around an item on a table.
  ;; It is gone for every robot, also for one whose hand was at it.
  (:action pick
    :parameters (?robot - robot ?item - item ?table - table)
    :precondition (and
      (handClear ?robot)
      (graspable ?item ?robot)
      (onTable ?item ?table))
    :effect (and
      (inHand ?item ?robot)
      (not (handClear ?robot))
      (not (onTable ?item ?table))
      (forall (?any - robot)
        (not (graspable ?item ?any)))))

  ;; Close the hand around an item in a drawer.
  (:action take-out
    :parameters (?robot - robot ?item - item ?drawer - drawer)
    :precondition (and
      (handClear ?robot)
      (graspable ?item ?robot)
      (insideDrawer ?item ?drawer))
    :effect (and
      (inHand ?item ?robot)
      (not (handClear ?robot))
      (not (insideDrawer ?item ?drawer))
      (forall (?any - robot)
        (not (graspable ?item ?any)))))

  ;; Put the item in the hand into a drawer.
  (:action put-in
    :parameters (?robot - robot ?item - item ?drawer - drawer)
    :precondition (and
      (not (handClear ?robot))
      (inHand ?item ?robot)
      (not (insideDrawer ?item ?drawer)))
    :effect (and
      (handClear ?robot)
      (insideDrawer ?item ?drawer)
      (not (inHand ?item ?robot))))

  ;; Put the item in the hand on a table.
  (:action put-on
    :parameters (?robot - robot ?item - item ?table - table)
    :precondition (and
      (not (handClear ?robot))
      (inHand ?item ?robot)
      (not (onTable ?item ?table)))
    :effect (and
      (handClear ?robot)
      (onTable ?item ?table)
      (not (inHand ?item ?robot)))))
