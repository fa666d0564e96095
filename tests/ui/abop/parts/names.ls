axiom: A(1)
n = 3
p1: A(x) -> F(y)A(x+)
p2: AB -> A
p3: F -0.3-> FF
