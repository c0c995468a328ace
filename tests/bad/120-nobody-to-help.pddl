; expect: W0808 at 3:18-3:24
; with: good/agents-domain.pddl
(define (problem moving)
  (:domain piano)
  (:objects ann - mover grand - piano hall - room)
  (:init (in ann hall) (stands grand hall))
  (:goal (raised grand)))
