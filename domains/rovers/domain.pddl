;; Rovers: they drive from place to place and take pictures, and every leg takes one level of their charge.
;;
;; Nothing charges them again. Under delete relaxation a level is never used up, so that every tour looks possible.

(define (domain rovers)
  (:requirements :strips :typing)

  (:types rover place level camera)

  (:predicates
    (at ?rover - rover ?place - place)             ; the rover is here
    (charge ?rover - rover ?level - level)         ; so much charge is left
    (below ?lower ?level - level)                  ; the level that comes next when one is used
    (path ?from ?to - place)                       ; a leg that can be driven
    (carries ?rover - rover ?camera - camera)      ; the rover has the camera
    (imaged ?place - place ?camera - camera))      ; there is a picture of the place from such a camera

  (:action drive
    :parameters (?rover - rover ?from ?to - place ?level ?lower - level)
    :precondition (and
      (at ?rover ?from)
      (path ?from ?to)
      (charge ?rover ?level)
      (below ?lower ?level))
    :effect (and
      (at ?rover ?to)
      (charge ?rover ?lower)
      (not (at ?rover ?from))
      (not (charge ?rover ?level))))

  (:action image
    :parameters (?rover - rover ?place - place ?camera - camera)
    :precondition (and (at ?rover ?place) (carries ?rover ?camera))
    :effect (imaged ?place ?camera)))
