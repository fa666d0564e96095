/* The quadratic Koch island (ABOP, figure 1.6). */
n = 3, δ = 90°
ω : F-F-F-F
p : F -> F-F+F+FF-F-F+F
