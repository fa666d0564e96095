angle increment: 2
