;; The dye goes into two wells, and a cap is on its vial.
;; The dye that fits into the pipette is enough for one well, so that a loaded pipette does not help.
(define (problem vials-p01)
  (:domain vials)
  (:objects
    dye-vial water-vial buffer-vial - vial
    a1 a2 - well
    dye water buffer - liquid)
  (:init
    (clean)
    (contains dye-vial dye)
    (contains water-vial water)
    (contains buffer-vial buffer)
    (uncapped water-vial) (uncapped buffer-vial))
  (:goal
    (and
      (in dye a1)
      (in dye a2)
      (in water a1))))
