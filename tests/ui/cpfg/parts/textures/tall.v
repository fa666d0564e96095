line style: cylinder
contour sides: 3
texture: F: tall.rgb
texture: F: tall.rgb R: 0.25
