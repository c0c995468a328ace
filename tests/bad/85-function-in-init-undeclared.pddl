; expect: E0107 at 8:27-8:30
; with: good/tank-domain.pddl
(define (problem filling)
  (:domain tanks)
  (:objects high low - tank)
  (:init (joined high low)
    (= (level high) 4) (= (room high) 0)
    (= (level low) 0) (= (rom low) 4))
  (:goal (>= (level low) 3)))
