# A curled horn: segments that turn, lengthen and thicken.
46
8
60
c(6)A
A=F&(7)>(3)'(1.035)!(1.05)A
@
