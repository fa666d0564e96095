angle increment: 90
initial line width: 3 pixels
