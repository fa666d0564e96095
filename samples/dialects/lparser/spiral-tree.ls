# A tree with three boughs at each node, each shorter and thinner; random turns (after the commands
# of Lparser's manual).
8
30
16
FFA
A='(.86)!(.84)F~(6)[&(34)B]>(120)[&(34)B]>(120)[&(34)B]>(97)A
B='(.86)!(.8)F[+(32)C]>(60)F[-(32)C]D
C='(.8)!(.75)F~(12)FD
D=[c(3)+(40)L][c(3)-(40)L]
L='(.5)Z{-(20)f+(20)f+(20)f-(20)|-(20)f+(20)f+(20)f}
@
