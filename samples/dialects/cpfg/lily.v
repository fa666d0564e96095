angle increment: 45
contour sides: 8
contour: 1 trough.con
line style: cylinder
