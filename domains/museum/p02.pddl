;; The vase is fragile, and the blankets are in the store, for which the badge is needed.
;; The gallery is guarded; its switch hangs in the store too.
(define (problem museum-p02)
  (:domain museum)
  (:objects
    hall gallery store - room
    vase - exhibit
    pass - badge)
  (:init
    (at hall)
    (in vase gallery)
    (fragile vase)
    (blankets store)
    (door hall gallery) (door hall store)
    (public hall) (public gallery)
    (armed gallery)
    (panel store gallery)
    (lies pass hall)
    (admits pass store))
  (:goal
    (and
      (in vase hall)
      (not (loaded vase))
      (armed gallery))))
