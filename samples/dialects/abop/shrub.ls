/* A shrub by node rewriting (ABOP, figure 1.24f). */
n = 5, δ = 22.5°
ω  : X
p1 : X -> F-[[X]+X]+F[+FX]-X
p2 : F -> FF
