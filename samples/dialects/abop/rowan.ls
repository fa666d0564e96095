/* A rowan: a stem with branches in a spiral, and leaves of several leaflets. */
#define ratio 0.82
#define spread 52
#define golden 137.5
n = 9, δ = 35°
width = 0.12

ω  : A(1, 0.12)
p1 : A(l, w) : l > 0.3 -> !(w)F(l)[&(spread)B(l*0.7, w*0.7)]/(golden)A(l*ratio, w*0.8)
p2 : A(l, w) : l <= 0.3 -> !(w)F(l)L
p3 : B(l, w) -0.6-> !(w)F(l)[+$B(l*0.7, w*0.7)][-$L]B(l*ratio, w*0.8)
p4 : B(l, w) -0.4-> !(w)F(l)[-$B(l*0.7, w*0.7)][+$L]B(l*ratio, w*0.8)
p5 : L -> [F(0.1)[+(60)~l(0.15)][-(60)~l(0.15)]F(0.1)[+(50)~l(0.15)][-(50)~l(0.15)]~l(0.15)]
