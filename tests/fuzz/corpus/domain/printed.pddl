1 (:action hold
2 :agent ?a – agent
3 :precondition (and
4 not(p ?a)
5 (exists (hold ?b ?l))))