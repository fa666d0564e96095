angle increment: 22
line style: polygon
