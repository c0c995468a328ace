; caveat: allow(conflicting-effects)
;; Table: a table that must be lifted at all its sides at once, and blocks that are carried on it.
;;
;; The example is as old as planning with concurrent actions (Boutilier and Brafman 2001, Kovács 2012).
;; It teaches action atoms in the condition of an effect: what a robot does has another outcome if others do something at the same time.
;; - A side that is lifted, or lowered, while another one stays tips the table, and all blocks fall down.
;; - The table moves only if every side is carried the same way.

(define (domain table)
  (:requirements :adl :multi-agent)

  (:types robot side block room)

  (:predicates
    (in ?robot - robot ?room - room)            ; the robot is in the room
    (free ?robot - robot)                       ; the robot holds no side
    (holds ?robot - robot ?side - side)         ; the robot holds the side
    (up ?side - side)                           ; the side is lifted
    (stands ?room - room)                       ; the table is in the room
    (onTable ?block - block)                    ; the block is on the table
    (onFloor ?block - block ?room - room))      ; the block is on the floor of the room

  ;; Go to another room with empty hands.
  (:action go
    :agent ?robot - robot
    :parameters (?from ?to - room)
    :precondition (and
      (free ?robot)
      (in ?robot ?from)
      (not (= ?from ?to)))
    :effect (and
      (in ?robot ?to)
      (not (in ?robot ?from))))

  ;; Heave a block on the table, which stands still meanwhile.
  (:action load
    :agent ?robot - robot
    :parameters (?block - block ?room - room)
    :precondition (and
      (free ?robot)
      (in ?robot ?room)
      (stands ?room)
      (onFloor ?block ?room)
      (forall (?side - side)
        (not (up ?side)))
      (forall (?other - robot)
        (and
          (not (load ?other ?block ?room))
          (forall (?side - side)
            (not (lift ?other ?side ?room))))))
    :effect (and
      (onTable ?block)
      (not (onFloor ?block ?room))))

  ;; Lift a side that nobody else lifts. The table tips unless every other side is up or is lifted too.
  (:action lift
    :agent ?robot - robot
    :parameters (?side - side ?room - room)
    :precondition (and
      (free ?robot)
      (in ?robot ?room)
      (stands ?room)
      (not (up ?side))
      (forall (?other - robot)
        (not (lift ?other ?side ?room))))
    :effect (and
      (up ?side)
      (holds ?robot ?side)
      (not (free ?robot))
      (when (exists (?low - side)
        (and
          (not (up ?low))
          (forall (?other - robot)
            (not (lift ?other ?low ?room)))))
        (forall (?block - block)
          (when (onTable ?block)
            (and
              (not (onTable ?block))
              (onFloor ?block ?room)))))))

  ;; Lower a side. The table tips unless every other side is down or is lowered too.
  (:action lower
    :agent ?robot - robot
    :parameters (?side - side ?room - room)
    :precondition (and
      (holds ?robot ?side)
      (stands ?room))
    :effect (and
      (free ?robot)
      (not (up ?side))
      (not (holds ?robot ?side))
      (when (exists (?high - side)
        (and
          (up ?high)
          (forall (?other - robot)
            (not (lower ?other ?high ?room)))))
        (forall (?block - block)
          (when (onTable ?block)
            (and
              (not (onTable ?block))
              (onFloor ?block ?room)))))))

  ;; Carry a side to another room, while every other side is carried there too.
  ;; For its own side the condition is true of itself: a positive action atom also counts the action that it stands in.
  (:action carry
    :agent ?robot - robot
    :parameters (?mine - side ?from ?to - room)
    :precondition (and
      (holds ?robot ?mine)
      (stands ?from)
      (not (= ?from ?to))
      (forall (?side - side)
        (exists (?other - robot)
          (carry ?other ?side ?from ?to))))
    :effect (and
      (stands ?to)
      (in ?robot ?to)
      (not (stands ?from))
      (not (in ?robot ?from)))))
