;; Hanoi with arms: the towers of Hanoi, played by one arm or by several at once.
;;
;; An arm picks up the top disc of a peg and later places it on a peg where no smaller disc is.
;; In one step each arm may do one thing, but no two arms may be at the same peg:
;; `pick` and `place` have negative action atoms for all that happens at their peg. Their own atom does not count there.

(define (domain hanoi-arms)
  (:requirements :adl :multi-agent)

  (:types arm disc peg)

  (:predicates
    (free ?arm - arm)                       ; the arm's hand is empty
    (holding ?arm - arm ?disc - disc)       ; the arm holds the disc
    (at ?disc - disc ?peg - peg)            ; the disc is on the peg
    (smaller ?disc ?other - disc))          ; the first disc is the smaller one

  ;; Take the top disc of a peg.
  (:action pick
    :agent ?arm - arm
    :parameters (?disc - disc ?peg - peg)
    :precondition (and
      (free ?arm)
      (at ?disc ?peg)
      (forall (?above - disc)
        (not (and (at ?above ?peg) (smaller ?above ?disc))))
      (forall (?other - arm ?any - disc)
        (and
          (not (pick ?other ?any ?peg))
          (not (place ?other ?any ?peg)))))
    :effect (and
      (holding ?arm ?disc)
      (not (free ?arm))
      (not (at ?disc ?peg))))

  ;; Place the disc in the hand on a peg without a smaller one.
  (:action place
    :agent ?arm - arm
    :parameters (?disc - disc ?peg - peg)
    :precondition (and
      (holding ?arm ?disc)
      (forall (?below - disc)
        (not (and (at ?below ?peg) (smaller ?below ?disc))))
      (forall (?other - arm ?any - disc)
        (and
          (not (pick ?other ?any ?peg))
          (not (place ?other ?any ?peg)))))
    :effect (and
      (at ?disc ?peg)
      (free ?arm)
      (not (holding ?arm ?disc)))))
