;; The red plate goes into the pink drawer, which is closed.
;; The blue drawer happens to be open, and a chair stands where it is in nobody's way.
(define (problem closed-drawer-plate)
  (:domain closed-drawer)
  (:objects
    red-plate green-plate - item
    pink-drawer blue-drawer - drawer
    table1 table2 - table
    chair1 - chair)
  (:init
    (hand-clear)
    (on red-plate table1)
    (on green-plate table2)
    (closed pink-drawer) (clear pink-drawer)
    (open blue-drawer) (clear blue-drawer))
  (:goal (inside red-plate pink-drawer)))
