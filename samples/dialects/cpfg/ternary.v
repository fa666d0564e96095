angle increment: 30
initial line width: 1
line style: cylinder
tropism direction: 0, -1, 0
initial elasticity: 0.22
