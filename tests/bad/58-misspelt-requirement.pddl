; expect: W0301 at 4:34-4:56
; with: good/problem.pddl
(define (domain harbour)
  (:requirements :strips :typing :negative-precondition)
  (:types
    crane ship - machine
    machine container - item
    item berth - object)
  (:constants gate - berth)
  (:predicates
    (at ?i - item ?b - berth)
    (on ?c - container ?s - ship)
    (channel ?from ?to - berth)
    (broken ?k - crane))
  (:action sail
    :parameters (?s - ship ?from ?to - berth)
    :precondition (and (at ?s ?from) (channel ?from ?to))
    :effect (and (not (at ?s ?from)) (at ?s ?to)))
  (:action load
    :parameters (?k - crane ?c - container ?s - ship ?b - berth)
    :precondition (and (at ?k ?b) (not (broken ?k)) (at ?c ?b) (at ?s ?b))
    :effect (and (not (at ?c ?b)) (on ?c ?s)))
  (:action unload
    :parameters (?k - crane ?c - container ?s - ship ?b - berth)
    :precondition (and (at ?k ?b) (not (broken ?k)) (on ?c ?s) (at ?s ?b))
    :effect (and (not (on ?c ?s)) (at ?c ?b))))
