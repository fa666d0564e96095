/* The dragon curve by edge rewriting (ABOP, figure 1.10a). */
n = 10, δ = 90°
ω  : Fl
p1 : Fl -> Fl+Fr+
p2 : Fr -> -Fl-Fr
