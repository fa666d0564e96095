angle increment: 1
