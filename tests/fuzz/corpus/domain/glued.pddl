(DEFINE (DOMAIN G) (:PREDICATES (On?x?y)(at?x -object)(either)(and)(object ?object))
(:ACTION Move:PARAMETERS(?x?y):PRECONDITION(on?X?Y):EFFECT(AND(NOT(ON?x?y))(oN?y?x))))