; A post office: with everything that can be run.
(define (domain post)
  (:requirements :adl :derived-predicates :action-costs)
  (:types
    letter parcel - item
    clerk van - carrier
    room street - place)
  (:constants hall - room)
  (:predicates
    (at ?x - (either item carrier) ?p - place)
    (carries ?c - carrier ?i - item)
    (idle ?c - carrier)
    (stamped ?i - item)
    (door ?from ?to - place)
    (near ?from ?to - place)
    (sorted))
  (:functions
    (length ?from ?to - place) - number
    (total-cost) - number)

  (:derived (near ?from ?to - place)
    (or (door ?from ?to)
      (exists (?over - place) (and (door ?from ?over) (near ?over ?to)))))

  (:action go
    :parameters (?c - carrier ?from ?to - place)
    :precondition (and (at ?c ?from) (door ?from ?to) (not (= ?from ?to)))
    :effect (and (not (at ?c ?from)) (at ?c ?to)
      (increase (total-cost) (length ?from ?to))))

  (:action take
    :parameters (?c - carrier ?i - item ?p - place)
    :precondition (and (idle ?c) (at ?c ?p) (at ?i ?p) (imply (= ?p hall) (stamped ?i)))
    :effect (and (carries ?c ?i) (not (idle ?c)) (not (at ?i ?p)) (increase (total-cost) 1)))

  (:action leave
    :parameters (?c - carrier ?i - item ?p - place)
    :precondition (and (carries ?c ?i) (at ?c ?p))
    :effect (and (not (carries ?c ?i)) (idle ?c) (at ?i ?p) (increase (total-cost) 1)))

  (:action stamp
    :parameters (?c - clerk)
    :precondition (and (at ?c hall) (idle ?c) (not (sorted)))
    :effect (and (sorted) (increase (total-cost) 0.5)
      (forall (?l - letter) (when (at ?l hall) (stamped ?l)))))

  (:action mix
    :parameters ()
    :precondition (and (sorted) (forall (?i - item) (or (stamped ?i) (not (at ?i hall)))))
    :effect (not (sorted)))
)
