;; Two of three capped vials are needed: the acid and the dye, each in two wells.
(define (problem vials-p02)
  (:domain vials)
  (:objects
    acid-vial dye-vial salt-vial water-vial buffer-vial - vial
    a1 a2 a3 - well
    acid dye salt water buffer - liquid)
  (:init
    (clean)
    (contains acid-vial acid)
    (contains dye-vial dye)
    (contains salt-vial salt)
    (contains water-vial water)
    (contains buffer-vial buffer)
    (uncapped water-vial) (uncapped buffer-vial))
  (:goal
    (and
      (in acid a1)
      (in acid a2)
      (in dye a2)
      (in dye a3)
      (in buffer a3))))
