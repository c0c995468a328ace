;; Stacking: one robot arm and cubes on a table.
;;
;; The arm holds one cube at a time and takes only a cube with nothing on it.
;; The table has room for every cube, so a cube can always be put down.

(define (domain stacking)
  (:requirements :strips :typing)

  (:types cube - object)

  (:predicates
    (onTable ?cube - cube)     ; the cube rests on the table
    (onTop ?up ?down - cube)   ; ?up rests on ?down
    (clear ?cube - cube)       ; nothing rests on the cube, and the arm does not hold it
    (holding ?cube - cube)     ; the cube is in the gripper
    (handClear))               ; the gripper is empty

  ;; Take a cube from the table.
  (:action pick
    :parameters (?cube - cube)
    :precondition (and (handClear) (onTable ?cube) (clear ?cube))
    :effect (and
      (holding ?cube)
      (not (handClear))
      (not (onTable ?cube))
      (not (clear ?cube))))

  ;; Put the cube in the gripper down on the table.
  (:action put
    :parameters (?cube - cube)
    :precondition (holding ?cube)
    :effect (and
      (handClear)
      (onTable ?cube)
      (clear ?cube)
      (not (holding ?cube))))

  ;; Set the cube in the gripper on top of another; it must be clear to take the load.
  (:action stack
    :parameters (?up ?down - cube)
    :precondition (and (holding ?up) (clear ?down))
    :effect (and
      (handClear)
      (onTop ?up ?down)
      (clear ?up)
      (not (holding ?up))
      (not (clear ?down))))

  ;; Take a cube from the top of another, which becomes clear.
  (:action unstack
    :parameters (?up ?down - cube)
    :precondition (and (handClear) (onTop ?up ?down) (clear ?up))
    :effect (and
      (holding ?up)
      (clear ?down)
      (not (handClear))
      (not (onTop ?up ?down))
      (not (clear ?up)))))
