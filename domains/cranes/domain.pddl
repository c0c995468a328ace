;; Cranes: ships sail between quays and take loads aboard, which cranes lift.
;;
;; A heavy load takes two cranes at once. Cranes stand fast, and none is ever built.

(define (domain cranes)
  (:requirements :strips :typing :equality :negative-preconditions)

  (:types
    load ship quay crane - object
    light heavy - load)

  (:predicates
    (stands ?crane - crane ?quay - quay)    ; the crane stands at the quay
    (moored ?ship - ship ?quay - quay)      ; the ship is at the quay
    (lies ?load - load ?quay - quay)        ; the load lies at the quay
    (aboard ?load - load ?ship - ship)      ; the load is on the ship
    (route ?from ?to - quay))               ; ships sail from here to there

  (:action sail
    :parameters (?ship - ship ?from ?to - quay)
    :precondition (and (moored ?ship ?from) (route ?from ?to))
    :effect (and
      (moored ?ship ?to)
      (not (moored ?ship ?from))))

  (:action lift
    :parameters (?load - light ?quay - quay ?ship - ship ?crane - crane)
    :precondition (and
      (lies ?load ?quay)
      (moored ?ship ?quay)
      (stands ?crane ?quay))
    :effect (and
      (aboard ?load ?ship)
      (not (lies ?load ?quay))))

  (:action lift-together
    :parameters (?load - heavy ?quay - quay ?ship - ship ?left ?right - crane)
    :precondition (and
      (lies ?load ?quay)
      (moored ?ship ?quay)
      (stands ?left ?quay)
      (stands ?right ?quay)
      (not (= ?left ?right)))
    :effect (and
      (aboard ?load ?ship)
      (not (lies ?load ?quay)))))
