angle increment: 30
tropism direction: 0.2,1.0,0.0
initial elasticity: 0.0
elasticity increment: 0.2
line style: cylinder
initial line width: 0.1
