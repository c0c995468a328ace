(define (problem p) (:domian post) (:object a - klerk b c - (either van letter) hall b)
 (:init (and (at a hall) (idle a)) (at b) (at b hall hall) (door ?x hall) (= (lenght hall hall) x) (= 3 4) (= (length hall hall) 1) (= (length hall hall) 2) idle (when (idle a) (idle a)) ((at) a))
 (:goal (at d hall) (or)) (:goal (near hall hall)) (:metric maximise (total-cost)) (:metric minimize 5)
