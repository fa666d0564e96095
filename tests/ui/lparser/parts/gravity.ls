recursion 3
angle 45
thickness 10
trope 0.5
axiom [&C][&B]
rule C = tFC
rule B = FA(0.25)
rule A = t
rule t = t
@
