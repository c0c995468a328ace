; Durations of all forms, effects at both ends and in between, and conditions at all times.
(define (domain courier)
  (:requirements :typing :durative-actions :duration-inequalities :continuous-effects
    :numeric-fluents :negative-preconditions :conditional-effects :universal-preconditions)
  (:types van place)
  (:predicates (at ?v - van ?p - place) (road ?from ?to - place) (open ?p - place) (start) (full ?v - van))
  (:functions
    (fuel ?v - van) (time-for ?from ?to - place) - number
    (rate) (delivered) - number)
  (:durative-action drive
    :parameters (?v - van ?from ?to - place)
    :duration (= ?duration (time-for ?from ?to))
    :condition (and
      (at start (at ?v ?from)) (at start (not (start)))
      (over all (road ?from ?to))
      (at end (open ?to))
      (at start (>= (fuel ?v) (* 2 ?duration)))
      (forall (?other - place) (over all (road ?from ?other))))
    :effect (and
      (at start (not (at ?v ?from)))
      (at end (at ?v ?to))
      (decrease (fuel ?v) (* #t (rate)))
      (at end (increase (delivered) 1))))
  (:durative-action refuel
    :parameters (?v - van ?p - place)
    :duration (and (>= ?duration 1) (at end (<= ?duration (/ (fuel ?v) 2))))
    :condition (over all (at ?v ?p))
    :effect (and
      (at end (assign (fuel ?v) (+ 10 (- (fuel ?v)) (rate))))
      (when (at start (open ?p)) (at end (full ?v)))
      (forall (?other - van) (at end (not (full ?other))))
      (at end (when (open ?p) (scale-up (fuel ?v) 1.5)))))
  (:durative-action unload
    :parameters (?v - van)
    :duration ()
    :effect (at end (scale-down (fuel ?v) ?duration)))
  (:action wait
    :precondition (start)
    :effect (not (start))))
