angle increment: 45
line style: cylinder
contour sides: 12
texture: F: birch.rgb H: l L: m E: m
texture: F: toothed.rgb H: l L: m E: d S
surface: l halves.s 1 2
