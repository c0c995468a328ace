;@ (:a
;@  :b)
(define (domain d)
   ;@ (:c)
   ;; d
;@ (:e)
(:predicates
;@ (:f)
(p)))