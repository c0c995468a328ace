; expect: W0807 at 15:18-15:36
(define (domain market)
  (:requirements :adl :multi-agent)
  (:types buyer melon)
  (:predicates
    (on-sale ?m - melon)
    (has ?b - buyer ?m - melon))
  (:action show
    :agent ?b - buyer
    :parameters (?m - melon)
    :precondition (and (has ?b ?m) (forall (?c - buyer) (not (show ?c ?m))))
    :effect (not (has ?b ?m)))
  (:action buy
    :agent ?b - buyer :parameters (?m - melon) :precondition (on-sale ?m)
    :effect (and (not (on-sale ?m)) (has ?b ?m))))
