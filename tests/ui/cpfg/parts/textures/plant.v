line style: cylinder
initial color: 5
texture: F: moss.rgb L: m H: l E: m S R: 2.0
texture: F:moss.rgb E:d
texture: F: bark.rle
