(define (domain couriers)
  (:requirements :typing :multi-agent :unfactored-privacy)
  (:types courier parcel place)
  (:predicates
    (lies ?p - parcel ?l - place)
    (:private ?c - courier
      (rides ?c - courier ?l - place)
      (carries ?c - courier ?p - parcel)))
  (:action ride
    :agent ?c - courier
    :parameters (?from ?to - place)
    :precondition (rides ?c ?from)
    :effect (and (not (rides ?c ?from)) (rides ?c ?to)))
  (:action take
    :agent ?c - courier
    :parameters (?p - parcel ?l - place)
    :precondition (and (rides ?c ?l) (lies ?p ?l))
    :effect (and (not (lies ?p ?l)) (carries ?c ?p))))
