# A shell: rings of polygons that grow along a spiral.
40
20
10
A
A=&(14)>(6)'(1.05)!(1.05)[+(90)Z]FA
@
