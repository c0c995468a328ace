;; The two cabinets are small, and their exhibits change places by way of the corridor.
(define (problem museum-p03)
  (:domain museum)
  (:objects
    corridor east west - room
    bust mask - exhibit)
  (:init
    (at corridor)
    (in bust east) (in mask west)
    (door corridor east) (door corridor west)
    (public corridor) (public east) (public west)
    (small east) (small west))
  (:goal
    (and
      (in bust west) (in mask east)
      (not (exists (?exhibit - exhibit) (loaded ?exhibit))))))
