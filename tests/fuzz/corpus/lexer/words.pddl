(aircraft?a ?t -truck ?x-?y a-b --c - –– :init #t 1e3 -.5)
