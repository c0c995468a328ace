;; Vials, after a human has shown the robot how a cap is taken off: `uncap` is new.

(define (domain vials)
  (:requirements :strips :typing)

  (:types vial well liquid)

  (:predicates
    (contains ?vial - vial ?liquid - liquid)    ; the vial contains the liquid
    (uncapped ?vial - vial)                     ; there is no cap on the vial
    (clean)                                     ; the pipette is empty and clean
    (wet)                                       ; the pipette is empty and has to be rinsed
    (loaded ?liquid - liquid)                   ; the liquid is in the pipette
    (in ?liquid - liquid ?well - well))         ; some of the liquid is in the well

  (:action draw
    :parameters (?liquid - liquid ?vial - vial)
    :precondition (and (clean) (uncapped ?vial) (contains ?vial ?liquid))
    :effect (and
      (loaded ?liquid)
      (not (clean))))

  ;; What was drawn is enough for one well.
  (:action dispense
    :parameters (?liquid - liquid ?well - well)
    :precondition (loaded ?liquid)
    :effect (and
      (in ?liquid ?well)
      (wet)
      (not (loaded ?liquid))))

  (:action rinse
    :parameters ()
    :precondition (wet)
    :effect (and
      (clean)
      (not (wet))))

  (:action uncap
    :parameters (?vial - vial)
    :precondition (clean)
    :effect (uncapped ?vial)))
