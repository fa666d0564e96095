#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Draws pinna.png, a leaflet of the first order of male-fern.lsys, with its pinnules.
Usage: samples/species/male-fern/pictures.py      Needs Pillow and NumPy (Debian: python3-pil, python3-numpy)."""
import os
import random
import sys

import numpy as np

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
from drawing import Card, leaf

os.chdir(os.path.dirname(os.path.abspath(__file__)))
draw = random.Random(3)

# Half widths of a pinnule, (part of its length, half width / length): an oblong with a blunt end, broad at its base.
# toothed() adds the teeth.
SHAPE = [(0, 0.19), (0.15, 0.19), (0.3, 0.155), (0.5, 0.155), (0.7, 0.15), (0.85, 0.13), (0.95, 0.08), (1, 0.03)]


def toothed():
    outline = []
    for i in range(23):
        t = i / 22
        half = float(np.interp(t, [p for p, _ in SHAPE], [w for _, w in SHAPE]))
        outline.append((t, half * (1.08 if i % 2 and t > 0.3 else 0.94)))
    return outline


card = Card(144, 512)
pinnules = 21
for i in range(pinnules):
    part = i / pinnules
    y = 0.03 + 0.93 * part
    for side in (-1, 1):
        length = 0.125 * (1 - part**1.5) ** 0.8 * (0.85 + 0.15 * min(1, 6 * part)) + 0.012
        tone = draw.uniform(0.84, 1)
        colour = (218 * tone, 226 * tone, 192 * tone)
        leaf(card, (0, y + (0.012 if side > 0 else 0)), side * (76 - 34 * part**2), length, toothed(), colour,
             (240, 244, 214), veins=5, vein_angle=38)
card.line([(0, 0), (0, 0.97)], 0.014, (206, 204, 150))
leaf(card, (0, 0.93), 0, 0.065, toothed(), (214, 222, 190), (240, 244, 214), veins=3)
card.save("pinna.png", levels=24)
