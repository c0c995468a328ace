;; Delivery: trucks of small capacity bring packages along roads of known length.
;;
;; The cost of a plan is the length of the roads driven, plus 1 for each loading or unloading.
;; The free room of a truck is an object of type `room`, because classical planning has no counters:
;; `more` links each amount of room to the next larger one.

(define (domain delivery)
  (:requirements :strips :typing :action-costs)

  (:types
    town room locatable - object
    truck package - locatable)

  (:predicates
    (at ?what - locatable ?town - town)         ; a truck or a package stands in the town
    (in ?package - package ?truck - truck)      ; the package is on the truck
    (road ?from ?to - town)                     ; one can drive from ?from to ?to
    (free ?truck - truck ?room - room)          ; how many more packages the truck can take
    (more ?less ?room - room))                  ; ?room is one package more than ?less

  (:functions
    (length ?from ?to - town) - number
    (total-cost) - number)

  (:action drive
    :parameters (?truck - truck ?from ?to - town)
    :precondition (and (at ?truck ?from) (road ?from ?to))
    :effect (and
      (at ?truck ?to)
      (not (at ?truck ?from))
      (increase (total-cost) (length ?from ?to))))

  (:action load
    :parameters (?package - package ?truck - truck ?town - town ?less ?room - room)
    :precondition (and
      (at ?package ?town)
      (at ?truck ?town)
      (free ?truck ?room)
      (more ?less ?room))
    :effect (and
      (in ?package ?truck)
      (free ?truck ?less)
      (not (at ?package ?town))
      (not (free ?truck ?room))
      (increase (total-cost) 1)))

  (:action unload
    :parameters (?package - package ?truck - truck ?town - town ?room ?extra - room)
    :precondition (and
      (in ?package ?truck)
      (at ?truck ?town)
      (free ?truck ?room)
      (more ?room ?extra))
    :effect (and
      (at ?package ?town)
      (free ?truck ?extra)
      (not (in ?package ?truck))
      (not (free ?truck ?room))
      (increase (total-cost) 1))))
