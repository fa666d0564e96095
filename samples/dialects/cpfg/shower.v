initial line width: 0.12
initial color: 20
