/* Constants, a condition,
   and a rule of two lines. */
#define R 1.4
n = 3, δ = 25.7°
#ignore: + -
ω : A(1)
p1 : A(x) : x < 3 → F(x)[+A(x*R)]
    [-A(x + R)]   // both twigs
p2 : A(x) : x >= 3 -> F(x)
