line style: polygon
initial color: 2
