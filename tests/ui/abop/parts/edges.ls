axiom: Fl
n = 3; delta = 90
Fl -> Fl+F_r+
F_r -> -Fl-F_r
