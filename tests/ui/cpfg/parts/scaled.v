line style: cylinder
initial line width: 0.2
initial scale: 2
scale factor: 0.7
