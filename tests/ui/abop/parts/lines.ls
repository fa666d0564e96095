axiom: A(1)
n = 3
n = 4
p1: A(x -> F(x)A(x+1)
foo: 3
axoim: C
p5: B(x) –> C(y)
some text of an author
#define
