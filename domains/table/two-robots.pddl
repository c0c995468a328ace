;; Two robots load two blocks and carry the table with both to the other room: load, lift, carry, lower.
;; shortest joint plan: 4 steps
(define (problem two-robots)
  (:domain table)
  (:objects
    ann bob - robot
    left right - side
    red blue - block
    hall kitchen - room)
  (:init
    (in ann hall) (in bob hall)
    (free ann) (free bob)
    (stands hall)
    (onFloor red hall) (onFloor blue hall))
  (:goal
    (and
      (onTable red)
      (onTable blue)
      (stands kitchen)
      (not (up left))
      (not (up right)))))
