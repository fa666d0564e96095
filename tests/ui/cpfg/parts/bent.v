angle increment: 30
tropism direction: 0.2,1.0,0.0
initial elasticity: 0.0
