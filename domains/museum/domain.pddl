;; Museum: a porter with a cart moves exhibits between rooms at night.
;;
;; Here the conditions do the work: who may enter, what may be loaded beside what,
;; and which room takes one exhibit only are disjunctions, implications and quantifiers.
;; What is on the cart stays `in` the room where the cart is, and moves with it.

(define (domain museum)
  (:requirements :adl)

  (:types room exhibit badge - object)

  (:predicates
    (at ?room - room)                       ; the porter and the cart are here
    (in ?exhibit - exhibit ?room - room)    ; the exhibit is in the room, on the cart or not
    (loaded ?exhibit - exhibit)             ; the exhibit is on the cart
    (fragile ?exhibit - exhibit)            ; travels alone, and on blankets
    (padded)                                ; the cart is lined with blankets
    (blankets ?room - room)                 ; blankets are stored in the room
    (door ?one ?other - room)               ; a door joins the rooms; stated one way
    (public ?room - room)                   ; anyone may enter while the alarm is off
    (small ?room - room)                    ; takes one exhibit only
    (armed ?room - room)                    ; the alarm of the room is on
    (panel ?panel ?room - room)             ; the switch for the alarm of ?room hangs in ?panel
    (lies ?badge - badge ?room - room)      ; the badge lies in the room
    (has ?badge - badge)                    ; the porter wears the badge
    (admits ?badge - badge ?room - room))   ; the badge opens the room, armed or not

  ;; A door serves both ways. A room is entered freely or with a badge.
  ;; Whatever is on the cart comes along.
  (:action go
    :parameters (?from ?to - room)
    :precondition (and
      (at ?from)
      (or (door ?from ?to) (door ?to ?from))
      (or
        (and (public ?to) (not (armed ?to)))
        (exists (?badge - badge)
          (and (has ?badge) (admits ?badge ?to)))))
    :effect (and
      (at ?to)
      (not (at ?from))
      (forall (?exhibit - exhibit)
        (when (loaded ?exhibit)
          (and
            (in ?exhibit ?to)
            (not (in ?exhibit ?from)))))))

  (:action take-badge
    :parameters (?badge - badge ?room - room)
    :precondition (and (at ?room) (lies ?badge ?room))
    :effect (and
      (has ?badge)
      (not (lies ?badge ?room))))

  (:action disarm
    :parameters (?panel ?room - room)
    :precondition (and (at ?panel) (panel ?panel ?room) (armed ?room))
    :effect (not (armed ?room)))

  (:action arm
    :parameters (?panel ?room - room)
    :precondition (and (at ?panel) (panel ?panel ?room) (not (armed ?room)))
    :effect (armed ?room))

  ;; Blankets go on an empty cart.
  (:action pad
    :parameters (?room - room)
    :precondition (and
      (at ?room)
      (blankets ?room)
      (not (padded))
      (not (exists (?exhibit - exhibit) (loaded ?exhibit))))
    :effect (padded))

  ;; A fragile exhibit needs the blankets, and shares the cart with nothing.
  (:action load
    :parameters (?exhibit - exhibit ?room - room)
    :precondition (and
      (at ?room)
      (in ?exhibit ?room)
      (not (loaded ?exhibit))
      (not (armed ?room))
      (imply (fragile ?exhibit) (padded))
      (forall (?other - exhibit)
        (imply (loaded ?other)
          (not (or (fragile ?exhibit) (fragile ?other))))))
    :effect (loaded ?exhibit))

  ;; A small room takes an exhibit only when no other is in it, not even on the cart.
  (:action unload
    :parameters (?exhibit - exhibit ?room - room)
    :precondition (and
      (at ?room)
      (loaded ?exhibit)
      (not (armed ?room))
      (imply (small ?room)
        (forall (?other - exhibit)
          (or (= ?other ?exhibit) (not (in ?other ?room))))))
    :effect (not (loaded ?exhibit))))
