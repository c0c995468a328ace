;; A new exhibition: four exhibits, two of them fragile, in seven rooms on two floors.
;; The upper floor has a switchboard and a badge of its own; in the morning every room that shows something is guarded.
(define (problem museum-p05)
  (:domain museum)
  (:objects
    hall east west office landing gallery attic - room
    vase lamp mask coin - exhibit
    pass key-card - badge)
  (:init
    (at hall)
    (in vase east) (in mask west) (in coin gallery) (in lamp attic)
    (fragile vase) (fragile lamp)
    (blankets office)
    (door hall east) (door hall west) (door hall office) (door hall landing)
    (door landing gallery) (door landing attic)
    (public hall) (public east) (public west) (public landing) (public gallery)
    (small east) (small west)
    (armed east) (armed west) (armed gallery) (armed attic)
    (panel office east) (panel office west) (panel office hall)
    (panel landing gallery) (panel landing attic)
    (lies pass hall) (lies key-card office)
    (admits pass office) (admits key-card attic) (admits key-card gallery))
  (:goal
    (and
      (in vase gallery) (in mask east) (in lamp west)
      (exists (?room - room)
        (and (in coin ?room) (public ?room) (not (= ?room gallery))))
      (forall (?exhibit - exhibit) (not (loaded ?exhibit)))
      (forall (?room - room)
        (imply
          (exists (?exhibit - exhibit) (in ?exhibit ?room))
          (armed ?room))))))
