/* A ternary tree after Honda without gravity: all branches leave at equal angles (ABOP, section 2.1). */
#define b 30
#define r 0.85
#define wr 0.72
n = 7
ω  : A(1, 0.12)
p1 : A(l, w) -> !(w)F(l)[&(b)A(l*r, w*wr)]/(120)[&(b)A(l*r, w*wr)]/(120)[&(b)A(l*r, w*wr)]
