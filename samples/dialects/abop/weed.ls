/* A weed with branches on both sides (ABOP, figure 1.24a). */
n = 5, δ = 25.7°
ω : F
p : F -> F[+F]F[-F]F
