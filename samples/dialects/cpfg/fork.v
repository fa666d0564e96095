angle increment: 45
line style: cylinder
