# Three branches at each fork.
7
20
12
FFA
A=!(.8)'(.9)F[&B]>(120)[&B]>(120)[&B]
B=~(8)FA
@
