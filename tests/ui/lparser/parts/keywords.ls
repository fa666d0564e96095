recursion 2
angle 30
thickness 80
shape 1
min_thickness 5
color 2 255 128 0
axiom FA

rule A = [+ FA][- FA] t(.2)
rule A = B
