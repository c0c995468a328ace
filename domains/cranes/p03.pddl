;; The only crane stands at the east quay, where all crates lie; the turbine lies at the west quay.
;; A second crane alone is not enough: the turbine has to lie where both are, or the first crane to stand where the turbine lies.
(define (problem cranes-p03)
  (:domain cranes)
  (:objects
    turbine - heavy
    crate1 crate2 crate3 - light
    crane1 - crane
    ship1 ship2 ship3 - ship
    west north east south - quay)
  (:init
    (stands crane1 east)
    (moored ship1 west) (moored ship2 north) (moored ship3 south)
    (lies turbine west) (lies crate1 east) (lies crate2 east) (lies crate3 east)
    (route west north) (route north west)
    (route north east) (route east north)
    (route east south) (route south east)
    (route south west) (route west south))
  (:goal
    (and
      (aboard turbine ship1)
      (aboard crate1 ship1)
      (aboard crate2 ship2)
      (aboard crate3 ship3)
      (moored ship1 north))))
