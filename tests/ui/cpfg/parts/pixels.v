initial line width: 3 pixels
line width increment: 4
