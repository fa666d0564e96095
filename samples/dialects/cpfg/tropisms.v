angle increment: 45
initial line width: 0.06
line style: cylinder
initial color: 0
tropism: T: 0 1 0
tropism: T: 0 1 0 A: 90
torque: T: 0 1 0
