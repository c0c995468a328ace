;; Keys: a robot walks a grid in which some cells are locked.
;;
;; A key opens the doors of its own colour and is not used up.
;; The robot carries one key at a time, so it has to plan where to leave which.

(define (domain keys)
  (:requirements :strips :typing)

  (:types cell key colour - object)

  (:predicates
    (at ?cell - cell)                         ; the robot stands here
    (lies ?key - key ?cell - cell)            ; the key lies here
    (carries ?key - key)                      ; the robot has the key in its hand
    (handClear)                               ; the robot carries no key
    (open ?cell - cell)                       ; one may walk into the cell
    (locked ?cell - cell ?colour - colour)    ; a door of this colour closes the cell
    (painted ?key - key ?colour - colour)     ; the colour of the doors that the key opens
    (beside ?here ?there - cell))             ; the cells share a side

  (:action walk
    :parameters (?here ?there - cell)
    :precondition (and (at ?here) (beside ?here ?there) (open ?there))
    :effect (and
      (at ?there)
      (not (at ?here))))

  ;; The robot unlocks a door from the next cell and keeps the key.
  (:action unlock
    :parameters (?here ?door - cell ?key - key ?colour - colour)
    :precondition (and
      (at ?here)
      (beside ?here ?door)
      (locked ?door ?colour)
      (carries ?key)
      (painted ?key ?colour))
    :effect (and
      (open ?door)
      (not (locked ?door ?colour))))

  (:action take
    :parameters (?key - key ?cell - cell)
    :precondition (and (at ?cell) (lies ?key ?cell) (handClear))
    :effect (and
      (carries ?key)
      (not (lies ?key ?cell))
      (not (handClear))))

  (:action drop
    :parameters (?key - key ?cell - cell)
    :precondition (and (at ?cell) (carries ?key))
    :effect (and
      (lies ?key ?cell)
      (handClear)
      (not (carries ?key)))))
