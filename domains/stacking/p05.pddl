;; Twelve cubes in four towers are sorted by number into three.
;; The goal fixes no cube as the one on the table, which leaves the arm some freedom.
(define (problem stacking-p05)
  (:domain stacking)
  (:objects c01 c02 c03 c04 c05 c06 c07 c08 c09 c10 c11 c12 - cube)
  (:init
    (handClear)
    (onTable c04) (onTop c11 c04) (onTop c01 c11) (clear c01)
    (onTable c09) (onTop c02 c09) (onTop c06 c02) (onTop c12 c06) (clear c12)
    (onTable c07) (onTop c10 c07) (clear c10)
    (onTable c03) (onTop c08 c03) (onTop c05 c08) (clear c05))
  (:goal
    (and
      (onTop c01 c02) (onTop c02 c03) (onTop c03 c04)
      (onTop c05 c06) (onTop c06 c07) (onTop c07 c08)
      (onTop c09 c10) (onTop c10 c11) (onTop c11 c12))))
