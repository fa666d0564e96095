/* Field plants by chance: leaves and flowers on a stem of random internodes (ABOP, figure 1.28). */
n = 5, δ = 18°
ω  : P
p1 : P -> I+[P+O]--//[--L]I[++L]-[PO]++PO
p2 : I -> FS[//&&L][//^^L]FS
p3 : S -(0.33)-> S[//&&L][//^^L]FS
p4 : S -(0.33)-> SFS
p5 : S -(0.34)-> S
p6 : L -> ['{+f-ff-f+|+f-ff-f}]
p7 : O -> [&&&E'/W////W////W////W////W]
p8 : E -> FF
p9 : W -> ['^F][{&&&&-f+f|-f+f}]
