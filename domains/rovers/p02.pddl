;; A tour of five legs, each there and back, takes ten levels, and rover1 has four left.
;; The second rover is full, but it has another camera.
;;
;;   base - dune - ridge - crater
;;           |
;;         plain - gorge
(define (problem rovers-p02)
  (:domain rovers)
  (:objects
    rover1 rover2 - rover
    wide narrow - camera
    base dune ridge crater plain gorge - place
    level0 level1 level2 level3 level4 level5 level6 level7 level8 level9
    level10 - level)
  (:init
    (at rover1 base) (at rover2 base)
    (charge rover1 level4) (charge rover2 level10)
    (carries rover1 wide) (carries rover2 narrow)
    (path base dune) (path dune base) (path dune ridge) (path ridge dune)
    (path ridge crater) (path crater ridge) (path dune plain) (path plain dune)
    (path plain gorge) (path gorge plain)
    (below level0 level1) (below level1 level2) (below level2 level3)
    (below level3 level4)
    (below level4 level5) (below level5 level6) (below level6 level7)
    (below level7 level8)
    (below level8 level9) (below level9 level10))
  (:goal
    (and
      (imaged crater wide)
      (imaged gorge wide)
      (imaged ridge narrow)
      (at rover1 base)
      (at rover2 base))))
