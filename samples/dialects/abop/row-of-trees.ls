/* A row of trees: the lengths of segments are parameters (ABOP, figure 1.36). */
#define p 0.3
#define q 0.7
#define h 0.458257569
n = 8, δ = 86°
ω  : -(90)F(1)
p1 : F(x) -> F(x*p)+F(x*h)--F(x*h)+F(x*q)
