;; Three legs to the crater and three back take six levels, and two are left:
;;
;;   base - dune - ridge - crater
(define (problem rovers-p01)
  (:domain rovers)
  (:objects
    rover1 - rover
    wide - camera
    base dune ridge crater - place
    level0 level1 level2 level3 level4 level5 level6 - level)
  (:init
    (at rover1 base)
    (charge rover1 level2)
    (carries rover1 wide)
    (path base dune) (path dune base) (path dune ridge) (path ridge dune)
    (path ridge crater) (path crater ridge)
    (below level0 level1) (below level1 level2) (below level2 level3)
    (below level3 level4)
    (below level4 level5) (below level5 level6))
  (:goal
    (and
      (imaged crater wide)
      (at rover1 base))))
