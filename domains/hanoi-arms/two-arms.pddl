;; Two arms move the same four discs. An arm can keep a disc in its hand, and one may pick while the other places.
;; shortest joint plan: 10 steps
(define (problem two-arms)
  (:domain hanoi-arms)
  (:objects
    left right - arm
    tiny small large huge - disc
    first second third - peg)
  (:init
    (smaller tiny small) (smaller tiny large) (smaller tiny huge)
    (smaller small large) (smaller small huge)
    (smaller large huge)
    (at tiny first) (at small first) (at large first) (at huge first)
    (free left) (free right))
  (:goal
    (and
      (at tiny third)
      (at small third)
      (at large third)
      (at huge third))))
