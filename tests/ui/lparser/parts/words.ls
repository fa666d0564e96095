recursion 2
angel 30
axiom A
rule A = AF
color 1 2
