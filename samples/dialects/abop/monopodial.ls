/* A monopodial tree after Honda (ABOP, figure 2.6a). */
#define r1 0.9
#define r2 0.6
#define a0 45
#define a2 45
#define d 137.5
#define wr 0.707
n = 10
ω  : A(1, 0.1)
p1 : A(l, w) -> !(w)F(l)[&(a0)B(l*r2, w*wr)]/(d)A(l*r1, w*wr)
p2 : B(l, w) -> !(w)F(l)[-(a2)$C(l*r2, w*wr)]C(l*r1, w*wr)
p3 : C(l, w) -> !(w)F(l)[+(a2)$B(l*r2, w*wr)]B(l*r1, w*wr)
