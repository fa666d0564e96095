angle increment: 30
initial line width: 0.1
line style: cylinder
initial color: 0
tropism: T: 0 -1 0 E: 0 S: 0.05
