(define (problem two-arms)
  (:domain sorting)
  (:objects
    hall - place
    (:private left left - arm cup1 - cup)
    (:private right right - arm cup2 - cup))
  (:init (at cup1 hall) (reaches left hall) (at cup2 table1) (reaches right table1))
  (:goal (holds left cup1)))
