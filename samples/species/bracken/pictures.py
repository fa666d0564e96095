#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Draws pinnule.png, a leaflet of the second order of bracken.lsys with its narrow, blunt lobes.
Usage: samples/species/bracken/pictures.py      Needs Pillow and NumPy (Debian: python3-pil, python3-numpy)."""
import os
import random
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
from drawing import Card, leaf

os.chdir(os.path.dirname(os.path.abspath(__file__)))
draw = random.Random(4)
LOBE = [(0, 0.2), (0.1, 0.19), (0.4, 0.16), (0.75, 0.15), (0.92, 0.1), (1, 0.02)]
card = Card(192, 512)
for i in range(17):
    part = i / 17
    for side in (-1, 1):
        length = 0.17 * (1 - part**1.3) ** 0.9 + 0.014
        tone = draw.uniform(0.82, 1)
        leaf(card, (0, 0.04 + 0.9 * part), side * (70 - 34 * part**2), length, LOBE, (216 * tone, 226 * tone, 190 * tone),
             (242, 246, 214), veins=3, vein_angle=40)
card.line([(0, 0), (0, 0.94)], 0.016, (210, 206, 150))
leaf(card, (0, 0.86), 0, 0.13, LOBE, (214, 222, 188), (240, 244, 210), veins=3)
card.save("pinnule.png", levels=24)
