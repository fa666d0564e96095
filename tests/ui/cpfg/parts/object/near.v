angle increment: 33
line style: polygon
