;; The turbine needs two cranes at once, and the harbour has one.
(define (problem cranes-p01)
  (:domain cranes)
  (:objects
    turbine - heavy
    crate1 - light
    crane1 - crane
    ship1 - ship
    west east - quay)
  (:init
    (stands crane1 west)
    (moored ship1 east)
    (lies turbine west) (lies crate1 west)
    (route west east) (route east west))
  (:goal
    (and
      (aboard turbine ship1)
      (aboard crate1 ship1)
      (moored ship1 east))))
