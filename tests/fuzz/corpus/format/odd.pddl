((()))() a ( b ) ((c) :d) (:action) (:action :effect) (and) (and a (b) c) (not

(not(not (x))))