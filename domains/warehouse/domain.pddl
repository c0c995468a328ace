;; Warehouse: carts that drive and cranes that load them, at a price.
;;
;; It teaches agents of two types, costs, and a goal for each agent of a type (in the problems).
;; A crane loads and unloads only a cart that stands still: negative action atoms name the drive of another agent.
;; The cost of a joint step is the sum of what its parts cost, so that hurrying may cost more than taking turns.

(define (domain warehouse)
  (:requirements :typing :negative-preconditions :universal-preconditions
    :action-costs :multi-agent)

  (:types
    agent crate place - object
    cart crane - agent)

  (:predicates
    (at ?agent - agent ?place - place)         ; the cart or crane is at the place
    (stored ?crate - crate ?place - place)     ; the crate is in the shelf of the place
    (carries ?cart - cart ?crate - crate)      ; the crate is on the cart
    (empty ?cart - cart)                       ; no crate is on the cart
    (road ?from ?to - place))                  ; a road leads from the one place to the other

  (:functions
    (total-cost) - number
    (distance ?from ?to - place) - number)

  ;; Drive along a road, at the price of its length, while nobody comes the other way.
  (:action drive
    :agent ?cart - cart
    :parameters (?from ?to - place)
    :precondition (and
      (at ?cart ?from)
      (road ?from ?to)
      (forall (?other - cart)
        (not (drive ?other ?to ?from))))
    :effect (and
      (at ?cart ?to)
      (not (at ?cart ?from))
      (increase (total-cost) (distance ?from ?to))))

  ;; Put a crate from the shelf on an empty cart that stands still, and that no other crane loads.
  (:action load
    :agent ?crane - crane
    :parameters (?crate - crate ?cart - cart ?place - place)
    :precondition (and
      (at ?crane ?place)
      (at ?cart ?place)
      (stored ?crate ?place)
      (empty ?cart)
      (forall (?to - place)
        (not (drive ?cart ?place ?to)))
      (forall (?other - crane ?any - crate)
        (not (load ?other ?any ?cart ?place)))
      (forall (?other - crane ?any - cart)
        (not (load ?other ?crate ?any ?place))))
    :effect (and
      (carries ?cart ?crate)
      (not (empty ?cart))
      (not (stored ?crate ?place))
      (increase (total-cost) 1)))

  ;; Put the crate from a cart that stands still into the shelf.
  (:action unload
    :agent ?crane - crane
    :parameters (?crate - crate ?cart - cart ?place - place)
    :precondition (and
      (at ?crane ?place)
      (at ?cart ?place)
      (carries ?cart ?crate)
      (forall (?to - place)
        (not (drive ?cart ?place ?to)))
      (forall (?other - crane)
        (not (unload ?other ?crate ?cart ?place))))
    :effect (and
      (stored ?crate ?place)
      (empty ?cart)
      (not (carries ?cart ?crate))
      (increase (total-cost) 1))))
