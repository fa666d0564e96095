tropism direction: 0 0 0
tropism: T: 0 up
texture: F: bark.rle
initial scale: -2
tsurface: t leaf.t 1
initial line width: thin
light: V: 1 1 1
// texture: in a comment
