; expect: W0705 at 6:61-6:73
; with: good/adl-domain.pddl
(define (problem evening)
  (:domain lamps)
  (:objects red blue - lamp hall attic - room)
  (:init (in red hall) (in blue attic) (old blue) (lit red) (dark attic))
  (:goal (and (lit blue) (dark hall))))
