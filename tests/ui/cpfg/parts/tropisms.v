angle increment: 30
line style: cylinder
initial line width: 0.1
tropism: T: 0 1 0 E: 0.2 S: 0.1
tropism: T: 0 2 0 I: 0.5 A: 90 /* across */
torque: T: 1 0 0 E: 0
