# Numbers, the axiom, rules and the end of the file.
3
20      # basic angle
15
c(12)[T]>(90)T%|$     # axiom
T='(1.3)F[+z.gH][-Zc]!?:;"~T
F=~F'
Z=Z_
K=K
@
text that is not read
