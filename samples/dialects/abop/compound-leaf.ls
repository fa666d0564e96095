/* A compound leaf whose branches begin later (ABOP, figure 5.11b). */
#define D 1
#define R 1.5
n = 13, δ = 45°
ω  : A(0)
p1 : A(d) : d > 0 -> A(d - 1)
p2 : A(d) : d = 0 -> F(1)[+A(D)][-A(D)]F(1)A(0)
p3 : F(a) -> F(a*R)
