;; Three arms open three bottles. While two are busy with one, the third puts away a lid or fetches the next bottle.
;; shortest joint plan: 7 steps
(define (problem three-bottles)
  (:domain bottle)
  (:objects
    left middle right - arm
    water juice wine - bottle
    cap lid cork - lid)
  (:init
    (free left) (free middle) (free right)
    (onTable water) (onTable juice) (onTable wine)
    (closed water cap) (closed juice lid) (closed wine cork))
  (:goal
    (and
      (not (closed water cap))
      (not (closed juice lid))
      (not (closed wine cork))
      (onTable water)
      (onTable juice)
      (onTable wine)
      (onTable cap)
      (onTable lid)
      (onTable cork))))
