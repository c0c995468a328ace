;; The red plate goes into the pink drawer, which is closed, and a chair stands before it.
;; The blue drawer is closed and free, and a second chair stands where it is in nobody's way.
(define (problem blocked-drawer-plate)
  (:domain blocked-drawer)
  (:objects
    red-plate green-plate - item
    pink-drawer blue-drawer - drawer
    table1 table2 - table
    chair1 chair2 - chair)
  (:init
    (hand-clear)
    (on red-plate table1)
    (on green-plate table2)
    (closed pink-drawer) (blocks chair1 pink-drawer)
    (closed blue-drawer) (clear blue-drawer))
  (:goal (inside red-plate pink-drawer)))
