angle increment: 30
contour sides: 6
contour: 1 blade.con
contour: 2 ring.con
contour: 3 missing.con
surface: l leaf.s 0.5
surface: m missing.s 1
