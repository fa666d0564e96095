axiom: A(1)B(1)C(1
n = 3
p2: A(x+1) -> B(x)
p3: B(x) : x < 2 ? -> B(x)
p4: B(x) -> C(x−1)
p5: C(x) : -> D
p6: D -> A(x)) <
p7: A(x) : x > 1 : x < 2 -> D
p8: A(x) : not x > 1 -> D
