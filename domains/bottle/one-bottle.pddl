;; Two arms open a bottle and put everything back on the table: pick up, unscrew and hold, put down.
;; shortest joint plan: 3 steps
(define (problem one-bottle)
  (:domain bottle)
  (:objects
    left right - arm
    water - bottle
    cap - lid)
  (:init
    (free left) (free right)
    (onTable water) (closed water cap))
  (:goal
    (and
      (not (closed water cap))
      (onTable water)
      (onTable cap))))
