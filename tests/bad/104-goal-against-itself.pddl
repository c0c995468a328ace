; expect: W0708 at 7:38-7:54
; with: good/adl-domain.pddl
(define (problem evening)
  (:domain lamps)
  (:objects red blue - lamp hall attic - room)
  (:init (in red hall) (in blue attic) (old blue) (lit red))
  (:goal (and (lit blue) (dark hall) (not (lit blue)))))
