#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Draws the pictures of dandelion.lsys: leaf.png (with lobes that point back) and parachute.png (the hairs of a fruit).
Usage: samples/species/dandelion/pictures.py      Needs Pillow and NumPy (Debian: python3-pil, python3-numpy)."""
import os
import random
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
from drawing import Card, along

os.chdir(os.path.dirname(os.path.abspath(__file__)))
draw = random.Random(6)
card = Card(192, 512)
green, vein = (208, 222, 180), (238, 232, 206)
for side in (-1, 1):
    places = [(0, 0), (side * 0.012, 0)]
    lobes = ((0.1, 0.03), (0.2, 0.06), (0.32, 0.1), (0.45, 0.135), (0.59, 0.155), (0.74, 0.16))
    for y, reach in lobes:
        y += draw.uniform(-0.02, 0.02)
        places += [(side * 0.022, y), (side * reach * 0.75, y + 0.0), (side * reach, y - 0.035), (side * reach * 0.72, y + 0.045),
                   (side * reach * 0.45, y + 0.062), (side * 0.026, y + 0.085)]
    places += [(side * 0.1, 0.86), (side * 0.145, 0.845), (side * 0.11, 0.93), (side * 0.05, 0.985), (0, 1)]
    card.fill_polygon(places, green if side < 0 else tuple(0.93 * part for part in green))
card.line([(0, 0), (0, 0.95)], 0.018, vein)
for y in (0.34, 0.47, 0.61, 0.76):
    for side in (-1, 1):
        card.line([(0, y - 0.02), (side * 0.1, y)], 0.006, vein)
card.save("leaf.png", levels=24)

card = Card(256, 256)
card.line([(0, 0), (0, 0.52)], 0.014, (214, 206, 186))
card.line([(0, 0), (0, 0.13)], 0.05, (112, 88, 56))
for k in range(44):
    card.line([(0, 0.5), along((0, 0.5), -96 + 192 * k / 43 + draw.uniform(-2, 2), draw.uniform(0.36, 0.48))], 0.011, (250, 250, 250))
card.save("parachute.png")
