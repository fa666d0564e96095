angle increment: 15
line style: cylinder
