;; Two rovers with two cameras: each tour has six legs and takes twelve levels, and five and three are left.
;;
;;   base - dune - ridge - crater
;;    |      |
;;    |    plain - gorge
;;    |
;;   cliff - shore - delta
(define (problem rovers-p03)
  (:domain rovers)
  (:objects
    rover1 rover2 - rover
    wide narrow - camera
    base dune ridge crater plain gorge cliff shore delta - place
    level0 level1 level2 level3 level4 level5 level6 level7 level8 level9
    level10 level11 level12 - level)
  (:init
    (at rover1 base) (at rover2 base)
    (charge rover1 level5) (charge rover2 level3)
    (carries rover1 wide) (carries rover2 narrow)
    (path base dune) (path dune base) (path dune ridge) (path ridge dune)
    (path ridge crater) (path crater ridge) (path dune plain) (path plain dune)
    (path plain gorge) (path gorge plain) (path base cliff) (path cliff base)
    (path cliff shore) (path shore cliff) (path shore delta) (path delta shore)
    (below level0 level1) (below level1 level2) (below level2 level3)
    (below level3 level4)
    (below level4 level5) (below level5 level6) (below level6 level7)
    (below level7 level8)
    (below level8 level9) (below level9 level10) (below level10 level11)
    (below level11 level12))
  (:goal
    (and
      (imaged crater wide)
      (imaged gorge wide)
      (imaged cliff wide)
      (imaged delta narrow)
      (imaged ridge narrow)
      (imaged plain narrow)
      (at rover1 base)
      (at rover2 base))))
