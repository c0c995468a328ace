; A post office: with what the language has, whether or not it can be run.
(define (domain post)
  (:requirements :typing :fluents :object-fluents :durative-actions :duration-inequalities
    :continuous-effects :timed-initial-literals :preferences :constraints :derived-predicates
    :disjunctive-preconditions :universal-preconditions :conditional-effects :equality
    :negative-preconditions :time :action-costs)
  (:types letter parcel - item clerk van - carrier room street - place)
  (:constants hall - room)
  (:predicates
    (at ?x - (either item carrier) ?p - place)
    (carries ?c - carrier ?i - item)
    (idle ?c - carrier)
    (door ?from ?to - place)
    (raining)
    (open ?p - place))
  (:functions
    (length ?from ?to - place) (fuel ?v - van) (total-cost) (wet ?i - item) - number
    (home ?c - carrier) - place)

  (:derived (open ?p - place) (or (= ?p hall) (not (raining))))

  (:constraints (and (forall (?v - van) (always (>= (fuel ?v) 0)))
    (sometime-before (raining) (open hall))))

  (:durative-action drive
    :parameters (?v - van ?from ?to - place)
    :duration (and (>= ?duration 1) (<= ?duration (* 2 (length ?from ?to))))
    :condition (and (at start (at ?v ?from)) (over all (> (fuel ?v) 0))
      (at start (preference dry (not (raining)))) (at end (open ?to)))
    :effect (and (at start (not (at ?v ?from))) (at end (at ?v ?to))
      (decrease (fuel ?v) (* #t 1.5)) (at end (increase (total-cost) ?duration))))

  (:action load
    :parameters (?v - van ?i - item ?p - place)
    :precondition (and (idle ?v) (at ?v ?p) (at ?i ?p) (door hall ?p) (< (+ (fuel ?v) 1) 10))
    :effect (and (carries ?v ?i) (not (at ?i ?p)) (assign (fuel ?v) (- (fuel ?v) 1))
      (when (= (home ?v) ?p) (assign (home ?v) hall))))

  (:process soak
    :parameters (?i - item ?p - street)
    :precondition (and (raining) (at ?i ?p))
    :effect (increase (wet ?i) (* #t 0.1)))

  (:event melt
    :parameters (?l - letter ?p - place)
    :precondition (and (at ?l ?p) (>= (wet ?l) 5))
    :effect (not (at ?l ?p)))
)
