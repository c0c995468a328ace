;; Drawers: a robot stores things in drawers that must be opened first, and a chair may be in the way.
;;
;; A chair stands before a drawer or in a corner of the room, one chair in each place.
;; A drawer opens only when no chair stands before it,
;; and while it is open no chair can be pushed there.

(define (domain drawers)
  (:requirements :strips :typing :negative-preconditions)

  (:types
    place item chair table - object
    drawer corner - place)

  (:predicates
    (onTable ?item - item ?table - table)       ; the item is on the table
    (inside ?item - item ?drawer - drawer)      ; the item is inside the drawer
    (inHand ?item - item)                       ; the robot holds the item
    (handClear)                                 ; the robot's hand is free
    (open ?place - place)                       ; the drawer is open; a corner never is
    (stands ?chair - chair ?place - place)      ; the chair stands before the drawer or in the corner
    (clear ?place - place)                      ; no chair stands there
    (light ?chair - chair)                      ; the robot can push the chair
    (way ?from ?to - place))                    ; a chair can be pushed from here to there

  (:action open-drawer
    :parameters (?drawer - drawer)
    :precondition (and (handClear) (clear ?drawer) (not (open ?drawer)))
    :effect (open ?drawer))

  (:action close-drawer
    :parameters (?drawer - drawer)
    :precondition (and (handClear) (open ?drawer))
    :effect (not (open ?drawer)))

  ;; Pushing takes the hand, and a free place to push to.
  (:action push
    :parameters (?chair - chair ?from ?to - place)
    :precondition (and
      (handClear)
      (light ?chair)
      (stands ?chair ?from)
      (way ?from ?to)
      (clear ?to)
      (not (open ?to)))
    :effect (and
      (stands ?chair ?to)
      (clear ?from)
      (not (stands ?chair ?from))
      (not (clear ?to))))

  (:action pick
    :parameters (?item - item ?table - table)
    :precondition (and (handClear) (onTable ?item ?table))
    :effect (and
      (inHand ?item)
      (not (handClear))
      (not (onTable ?item ?table))))

  (:action put-on
    :parameters (?item - item ?table - table)
    :precondition (inHand ?item)
    :effect (and
      (onTable ?item ?table)
      (handClear)
      (not (inHand ?item))))

  (:action put-in
    :parameters (?item - item ?drawer - drawer)
    :precondition (and (inHand ?item) (open ?drawer))
    :effect (and
      (inside ?item ?drawer)
      (handClear)
      (not (inHand ?item))))

  (:action take-out
    :parameters (?item - item ?drawer - drawer)
    :precondition (and (handClear) (inside ?item ?drawer) (open ?drawer))
    :effect (and
      (inHand ?item)
      (not (handClear))
      (not (inside ?item ?drawer)))))
