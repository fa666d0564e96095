line style: cylinder
angle increment: 45
