angle increment: 11
line style: polygon
