;; Close one switch and the town has current; in the maps, = is a closed line, - an open one, x a broken one.
;;
;;   plant -north- town
(define (problem circuits-p01)
  (:domain circuits)
  (:objects
    plant town - node
    north - line)
  (:init
    (feeds plant)
    (joins north plant town) (joins north town plant))
  (:goal (powered town)))
