; What to demonstrate: from this initial state reach this goal.
(define (problem closed-drawer-plate)
  (:domain closed-drawer)
  (:requirements :negative-preconditions)
  (:objects
    red-plate green-plate - item
    pink-drawer blue-drawer - drawer
    table1 table2 - table
    chair1 - chair)
  (:init
    (hand-clear)
    (on red-plate table1)
    (on green-plate table2)
    (closed pink-drawer)
    (clear pink-drawer)
    (open blue-drawer)
    (clear blue-drawer))
  (:goal (and (open pink-drawer) (not (closed pink-drawer)))))
