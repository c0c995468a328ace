(define (domain kitchen)
(:requirements :typing :strips)
(:types robot object table drawer
       fork knife spoon plate bowl glass - object)

(:predicates
 (onTable ?obj - object ?tab - table) ; Object is on
   top of a table
 (insideDrawer ?obj - object ?draw - drawer) ; Object
  is inside a drawer
(inHand ?obj - object ?rob - robot) ; Object is in
  robot hand
(handClear ?rob - robot) ; Robot hand is free
(graspable ?obj - object ?rob - robot) ; Object is
  within reach of the robot
)
; Action to reach an object
(:action reach
 :parameters (?rob - robot ?obj - object ?tab - table)
 :precondition (and
   (handClear ?rob)
   (not (inHand ?obj ?rob))
   (onTable ?obj ?tab))
 :effect (and
     (graspable ?obj ?rob)
     (forall (?o - object) ; makes all other objects
         non-graspable
         (when (not (= ?o ?obj))
             (not (graspable ?o ?rob))))))
)
; Action to pick an object from a table
(:action pick
    :parameters (?rob - robot ?obj - object ?tab - table)
    :precondition (and
        (handClear ?rob)
        (graspable ?obj ?rob)
        (onTable ?obj ?tab))
    :effect (and
        (not (handClear ?rob))
        (inHand ?obj ?rob)
        (not (graspable ?obj ?rob)))
)

; Action to put an object into a drawer
(:action put-in
    :parameters (?rob - robot ?obj - object ?draw - drawer)
    :precondition (and
        (not (handClear ?rob))
        (inHand ?obj ?rob)
        (not (insideDrawer ?obj ?draw)))
    :effect (and
        (handClear ?rob)
        (not (inHand ?obj ?rob))
        (insideDrawer ?obj ?draw))
)
)
