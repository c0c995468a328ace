;; A kitchen robot that opens and closes drawers, but has never seen how a chair is moved.
;;
;; A drawer opens only when no chair blocks it. The robot sees which chair does, but none of its actions is about that.

(define (domain blocked-drawer)
  (:requirements :strips :typing)

  (:types item drawer table chair)

  ; caveat: allow(unused-predicate)
  (:predicates
    (hand-clear)                                 ; the robot's hand is free
    (holding ?item - item)                       ; the robot has the item in its hand
    (on ?item - item ?table - table)             ; the item is on the table
    (inside ?item - item ?drawer - drawer)       ; the item is inside the drawer
    (open ?drawer - drawer)                      ; the drawer is open
    (closed ?drawer - drawer)                    ; the drawer is closed
    (clear ?drawer - drawer)                     ; no chair blocks the drawer
    (blocks ?chair - chair ?drawer - drawer))    ; the chair stands before the drawer

  ;@ (:exactly-one (open ?drawer) (closed ?drawer))
  ;@ (:exactly-one (clear ?drawer) (blocks ?chair ?drawer))

  (:action pick
    :parameters (?item - item ?table - table)
    :precondition (and (hand-clear) (on ?item ?table))
    :effect (and
      (holding ?item)
      (not (hand-clear))
      (not (on ?item ?table))))

  (:action put-on
    :parameters (?item - item ?table - table)
    :precondition (holding ?item)
    :effect (and
      (on ?item ?table)
      (hand-clear)
      (not (holding ?item))))

  (:action put-in
    :parameters (?item - item ?drawer - drawer)
    :precondition (and (holding ?item) (open ?drawer))
    :effect (and
      (inside ?item ?drawer)
      (hand-clear)
      (not (holding ?item))))

  (:action take-out
    :parameters (?item - item ?drawer - drawer)
    :precondition (and (hand-clear) (inside ?item ?drawer) (open ?drawer))
    :effect (and
      (holding ?item)
      (not (hand-clear))
      (not (inside ?item ?drawer))))

  (:action open-drawer
    :parameters (?drawer - drawer)
    :precondition (and (hand-clear) (clear ?drawer) (closed ?drawer))
    :effect (and
      (open ?drawer)
      (not (closed ?drawer))))

  (:action close-drawer
    :parameters (?drawer - drawer)
    :precondition (and (hand-clear) (open ?drawer))
    :effect (and
      (closed ?drawer)
      (not (open ?drawer)))))
