(define (domain ferry)
  (:requirements :typing :durative-actions :numeric-fluents)
  (:types boat shore)
  (:predicates
    (moored ?b - boat ?s - shore)
    (open ?s - shore))
  (:functions (hours ?from ?to - shore) - number)
  (:durative-action cross
    :parameters (?b - boat ?from ?to - shore)
    :duration (= ?duration (hours ?from ?to))
    :condition (and (at start (moored ?b ?from)) (over all (open ?to)))
    :effect (and (at start (not (moored ?b ?from))) (at end (moored ?b ?to)))))
