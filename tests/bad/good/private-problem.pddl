(define (problem round)
  (:domain couriers)
  (:objects
    home shop - place letter - parcel
    (:private ann - courier))
  (:init (rides ann home) (lies letter shop))
  (:goal (carries ann letter)))
