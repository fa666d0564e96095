#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Writes frame.obj, the shape to which topiary.lsys is clipped: a cone, a collar and a ball, turned on a lathe.
Usage: samples/topiary/frame.py"""
import math
import os

SIDES = 32
BALL = [(0.3 * math.sin(math.radians(a)), 1.46 - 0.3 * math.cos(math.radians(a))) for a in range(30, 180, 15)]
# Radius and height, m, from the bottom to the top; vertices on the axis close the first and the last ring.
RINGS = [(0.52, 0.18), (0.6, 0.26), (0.6, 0.36), (0.2, 1.04), (0.29, 1.1), (0.29, 1.15), (0.15, 1.19)] + BALL

os.chdir(os.path.dirname(os.path.abspath(__file__)))
lines = ["# A cone with a ball on top, m. Written by frame.py."]
for radius, height in RINGS:
    for side in range(SIDES):
        angle = 2 * math.pi * side / SIDES
        lines.append(f"v {radius * math.cos(angle):.4f} {height:.4f} {radius * math.sin(angle):.4f}")
lines.append(f"v 0 {RINGS[0][1]:.4f} 0")
lines.append(f"v 0 {1.46 + 0.3:.4f} 0")
bottom, top = len(RINGS) * SIDES + 1, len(RINGS) * SIDES + 2
for side in range(SIDES):
    after = (side + 1) % SIDES
    lines.append(f"f {side + 1} {after + 1} {bottom}")
    for ring in range(len(RINGS) - 1):
        low, high = ring * SIDES + 1, (ring + 1) * SIDES + 1
        lines.append(f"f {low + side} {high + side} {high + after} {low + after}")
    last = (len(RINGS) - 1) * SIDES + 1
    lines.append(f"f {last + side} {top} {last + after}")
with open("frame.obj", "w", encoding="ascii", newline="\n") as file:
    file.write("\n".join(lines) + "\n")
