;; The bust moves from the hall to the gallery next door.
(define (problem museum-p01)
  (:domain museum)
  (:objects
    hall gallery - room
    bust - exhibit)
  (:init
    (at hall)
    (in bust hall)
    (door hall gallery)
    (public hall) (public gallery))
  (:goal (and (in bust gallery) (not (loaded bust)))))
