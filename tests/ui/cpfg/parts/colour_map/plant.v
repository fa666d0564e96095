line style: polygon
