(define (problem round)
  (:domain couriers)
  (:objects
    home shop - place letter card - parcel
    (:private ann - courier))
  (:init (rides ann home) (lies letter shop) (carries ann card))
  (:goal (carries ann letter)))
