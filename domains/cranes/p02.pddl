;; Two things need two cranes at once, in a harbour of three quays with two ships and one crane.
(define (problem cranes-p02)
  (:domain cranes)
  (:objects
    turbine boiler - heavy
    crate1 crate2 - light
    crane1 - crane
    ship1 ship2 - ship
    west north east - quay)
  (:init
    (stands crane1 north)
    (moored ship1 east) (moored ship2 west)
    (lies turbine north) (lies boiler north) (lies crate1 north)
    (lies crate2 north)
    (route west north) (route north west)
    (route north east) (route east north))
  (:goal
    (and
      (aboard turbine ship1)
      (aboard crate1 ship1)
      (aboard boiler ship2)
      (aboard crate2 ship2)
      (moored ship1 west)
      (moored ship2 east))))
