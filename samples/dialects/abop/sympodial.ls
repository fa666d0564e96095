/* A sympodial tree after Aono and Kunii (ABOP, figure 2.7b). */
#define r1 0.9
#define r2 0.7
#define a1 10
#define a2 60
#define wr 0.707
n = 10
ω  : A(1, 0.1)
p1 : A(l, w) -> !(w)F(l)[&(a1)B(l*r1, w*wr)]/(180)[&(a2)B(l*r2, w*wr)]
p2 : B(l, w) -> !(w)F(l)[+(a1)$B(l*r1, w*wr)][-(a2)$B(l*r2, w*wr)]
