/* Three rules of equal chance (ABOP, figure 1.27). */
n = 5, δ = 25°, seed = 4
ω  : F
p1 : F -0.33-> F[+F]F[-F]F
p2 : F -0.33-> F[+F]F
p3 : F -0.34-> F[-F]F
