# A fern: fronds in a spiral, each with pairs of leaflets that become shorter.
14              # recursion depth
24              # basic angle
9               # thickness in percent of the length
c(8)A
A=[&(50)B]>(137.5)A
B=!(.9)'(.93)~(3)F[+(60)L][-(60)L]&(4)B
L='(.35)Z{-f+f+f-|-f+f+f}
@
