/* The hexagonal Gosper curve (ABOP, figure 1.11a). */
n = 4, δ = 60°
ω  : Fl
p1 : Fl -> Fl+Fr++Fr-Fl--FlFl-Fr+
p2 : Fr -> -Fl+FrFr++Fr+Fl--Fl-Fr
