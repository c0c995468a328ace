;; Five of eight capped vials are needed, each for two wells or three.
(define (problem vials-p03)
  (:domain vials)
  (:objects
    acid-vial dye-vial enzyme-vial ethanol-vial primer-vial resin-vial salt-vial
    serum-vial water-vial buffer-vial - vial
    a1 a2 a3 a4 b1 b2 b3 b4 - well
    acid dye enzyme ethanol primer resin salt serum water buffer - liquid)
  (:init
    (clean)
    (contains acid-vial acid)
    (contains dye-vial dye)
    (contains enzyme-vial enzyme)
    (contains ethanol-vial ethanol)
    (contains primer-vial primer)
    (contains resin-vial resin)
    (contains salt-vial salt)
    (contains serum-vial serum)
    (contains water-vial water)
    (contains buffer-vial buffer)
    (uncapped water-vial) (uncapped buffer-vial))
  (:goal
    (and
      (in acid a1)
      (in acid a2)
      (in dye a2)
      (in dye a3)
      (in dye a4)
      (in enzyme b1)
      (in enzyme b2)
      (in primer b3)
      (in primer b4)
      (in serum a1)
      (in serum b4)
      (in water a1)
      (in water b1)
      (in buffer a4)
      (in buffer b2))))
