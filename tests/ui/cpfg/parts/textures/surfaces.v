line style: cylinder
texture: F: moss.rgb R: 2 S:
texture: F: moss.rgb E: d
surface: k leaf.s 2
surface: l leaf.s 2 2
surface: m leaf.s 1 3 5 0
surface: n leaf.s 1 0 12 9
