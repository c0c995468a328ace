;; Bottle: to open a bottle, one arm holds it and another unscrews the lid, at the same time.
;;
;; `unscrew` and `hold` follow the thesis, section 3.1.4, where each names the other in its precondition.
;; Such a positive action atom is true only if that action stands in the same joint step, so neither is ever done alone.
;; Mended here, because the printed text is not PDDL or leaves something out:
;; - An arm that unscrews has an empty hand; the printed precondition asks only that the lid is not in it.
;; - Two arms do not unscrew one lid: a negative action atom forbids it.
;; - `pick-up` and `put-down` are added, so that bottles come into hands and out of them.

(define (domain bottle)
  (:requirements :typing :negative-preconditions :existential-preconditions
    :universal-preconditions :multi-agent)

  (:types
    arm thing - object
    bottle lid - thing)

  (:predicates
    (free ?arm - arm)                        ; the arm's hand is empty
    (inHand ?thing - thing ?arm - arm)       ; the arm holds the thing
    (onTable ?thing - thing)                 ; the thing lies on the table
    (closed ?bottle - bottle ?lid - lid))    ; the lid is on the bottle

  ;; Take something from the table; only one arm may reach for it.
  (:action pick-up
    :agent ?arm - arm
    :parameters (?thing - thing)
    :precondition (and
      (free ?arm)
      (onTable ?thing)
      (forall (?other - arm)
        (not (pick-up ?other ?thing))))
    :effect (and
      (inHand ?thing ?arm)
      (not (free ?arm))
      (not (onTable ?thing))))

  ;; Put on the table what the arm holds.
  (:action put-down
    :agent ?arm - arm
    :parameters (?thing - thing)
    :precondition (inHand ?thing ?arm)
    :effect (and
      (onTable ?thing)
      (free ?arm)
      (not (inHand ?thing ?arm))))

  ;; Take the lid off a bottle that another arm holds meanwhile.
  (:action unscrew
    :agent ?arm - arm
    :parameters (?lid - lid ?bottle - bottle)
    :precondition (and
      (free ?arm)
      (closed ?bottle ?lid)
      (exists (?other - arm)
        (hold ?other ?bottle ?lid))
      (forall (?other - arm)
        (not (unscrew ?other ?lid ?bottle))))
    :effect (and
      (inHand ?lid ?arm)
      (not (free ?arm))
      (not (closed ?bottle ?lid))))

  ;; Hold a bottle while another arm unscrews its lid.
  (:action hold
    :agent ?arm - arm
    :parameters (?bottle - bottle ?lid - lid)
    :precondition (and
      (inHand ?bottle ?arm)
      (closed ?bottle ?lid)
      (exists (?other - arm)
        (unscrew ?other ?lid ?bottle)))
    :effect (not (closed ?bottle ?lid))))
