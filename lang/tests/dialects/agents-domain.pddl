(define (domain lifting)
  (:requirements :adl :multi-agent :action-costs)
  (:types arm table)
  (:constants boss - arm)
  (:predicates (up ?t - table) (free ?a - arm) (seen ?t - table))
  (:functions (effort) - number)
  (:action lift
    :agent ?a - arm
    :parameters (?t - table)
    :precondition (and (free ?a)
      (exists (?b - arm) (and (not (= ?a ?b)) (lift ?b ?t)))
      (forall (?b - arm) (not (push ?b ?t))))
    :effect (and (when (command boss ?t) (up ?t)) (increase (effort) 2)))
  (:action push
    :agent (?a - arm)
    :parameters (?t - table)
    :precondition (forall (?b - arm) (not (lift ?b ?t)))
    :effect (not (up ?t)))
  (:action look
    :agent arm
    :parameters (?t - table)
    :effect (seen ?t))
  (:action command
    :agent boss
    :parameters (?t - table)
    :precondition (free boss)
    :effect (seen ?t))
  (:action shake
    :parameters (?t - table)
    :precondition (up ?t)
    :effect (not (up ?t))))
