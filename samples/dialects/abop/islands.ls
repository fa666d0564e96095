/* Islands and lakes: f moves without drawing (ABOP, figure 1.8). */
n = 2, δ = 90°
ω : F+F+F+F
p1: F -> F+f-FF+F+FF+Ff+FF-f+FF-F-FF-Ff-FFF
p2: f -> ffffff
