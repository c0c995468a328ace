;; The vase and the mask change cabinets, the bust comes out of the store,
;; and in the morning every room that shows something is guarded.
(define (problem museum-p04)
  (:domain museum)
  (:objects
    hall east west office store - room
    vase mask bust - exhibit
    pass - badge)
  (:init
    (at hall)
    (in vase east) (in mask west) (in bust store)
    (fragile vase)
    (blankets store)
    (door hall east) (door hall west) (door hall office) (door office store)
    (public hall) (public east) (public west) (public office)
    (small east) (small west)
    (armed east) (armed west)
    (panel office east) (panel office west) (panel office hall)
    (lies pass office)
    (admits pass store) (admits pass east) (admits pass west) (admits pass hall))
  (:goal
    (and
      (in vase west) (in mask east)
      (or (in bust hall) (in bust office))
      (forall (?exhibit - exhibit) (not (loaded ?exhibit)))
      (forall (?room - room)
        (imply
          (exists (?exhibit - exhibit) (in ?exhibit ?room))
          (armed ?room))))))
