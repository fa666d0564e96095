angle increment: 45
line style: cylinder
surface: l blade.s 1
