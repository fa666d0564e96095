contour sides: 24
contour: 1 ridge.con
line style: cylinder
