/* A bush in three dimensions; leaves are polygons (ABOP, figure 1.25). */
n = 7, δ = 22.5°, width = 0.4
ω  : A
p1 : A -> [&FL!A]/////[&FL!A]///////[&FL!A]
p2 : F -> S/////F
p3 : S -> FL
p4 : L -> [^^{-f+f+f-|-f+f+f}]
