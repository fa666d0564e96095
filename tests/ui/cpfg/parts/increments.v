initial color: 200
color increment: 30
line style: cylinder
