#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Draws the pictures of lombardy-poplar.lsys: bark.jpg and its normals, spray.png (a twig with leaves) and twig.png
(the same without leaves).
Usage: samples/species/lombardy-poplar/pictures.py      Needs Pillow and NumPy (Debian: python3-pil, python3-numpy)."""
import os
import random
import sys

import numpy as np

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
from drawing import Card, along, blend, field, leaf, save_bark

os.chdir(os.path.dirname(os.path.abspath(__file__)))
draw = random.Random(23)
# Half of a leaf: a broad triangle with a long tip.
DELTA = [(0, 0), (0.02, 0.2), (0.1, 0.37), (0.2, 0.43), (0.32, 0.4), (0.5, 0.27), (0.7, 0.14), (0.88, 0.05), (1, 0)]


def leafy(card, place, direction, length, bend, leaves):
    """A twig with leaves on long stalks; its tip turns by `bend` degrees."""
    steps = max(3, round(length / 0.06))
    heading = direction
    for i in range(steps):
        ahead = along(place, heading, length / steps)
        card.line([place, ahead], 0.009 if leaves else 0.014, (150, 134, 104))
        place = ahead
        heading += bend / steps + draw.uniform(-6, 6)
        if not leaves:
            continue
        tone = draw.uniform(0.72, 1)
        hue = draw.uniform(-10, 10)
        leaf(card, place, heading + (1 if i % 2 else -1) * draw.uniform(30, 80), draw.uniform(0.085, 0.115), DELTA,
             ((214 + hue) * tone, 222 * tone, (192 - hue) * tone), (242 * tone, 244 * tone, 206 * tone), veins=5,
             vein_angle=46, stalk=0.5)


for name, leaves in (("spray.png", True), ("twig.png", False)):
    card = Card(320, 512)
    for start, direction, length, bend in ((0.03, -36, 0.5, 34), (0.08, 38, 0.5, -36), (0.25, -32, 0.45, 30),
                                           (0.34, 32, 0.42, -30), (0.52, -26, 0.3, 24), (0.58, 26, 0.28, -24)):
        leafy(card, (0, start), direction, length, bend, leaves)
    leafy(card, (0, 0), 0, 0.86, 4, leaves)
    card.save(name, levels=20)

size = 512
crack = np.clip(np.abs(field(size, 9, 40, 41) + 0.4 * field(size, 7, 14, 42)) / 0.7, 0, 1)
rough = field(size, 1.3, 3, 43)
save_bark("bark.jpg", blend((40, 36, 31), (128, 118, 102), crack**0.8) * (1 + 0.09 * rough)[..., None], crack, 5.0)
