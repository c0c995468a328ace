;; One arm moves four discs: 15 moves as in the old puzzle, each of which is a step to pick and a step to place.
;; shortest joint plan: 30 steps
(define (problem one-arm)
  (:domain hanoi-arms)
  (:objects
    left - arm
    tiny small large huge - disc
    first second third - peg)
  (:init
    (smaller tiny small) (smaller tiny large) (smaller tiny huge)
    (smaller small large) (smaller small huge)
    (smaller large huge)
    (at tiny first) (at small first) (at large first) (at huge first)
    (free left))
  (:goal
    (and
      (at tiny third)
      (at small third)
      (at large third)
      (at huge third))))
