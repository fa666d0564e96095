/* Branch lengths in a ratio: a tree in a plane whose twigs become denser (ABOP, figure 1.39). */
#define R 1.456
n = 10, δ = 85°
ω  : A
p1 : A -> F(1)[+A][-A]
p2 : F(s) -> F(s*R)
