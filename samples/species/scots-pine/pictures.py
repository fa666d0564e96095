#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Draws the pictures of scots-pine.lsys: base.jpg and bark.jpg (the bark at the base and above) with their normals,
middle.jpg (the bark between them) and spray.png (a twig with tufts of needles).
Usage: samples/species/scots-pine/pictures.py      Needs Pillow and NumPy (Debian: python3-pil, python3-numpy)."""
import os
import random
import sys

import numpy as np

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
from drawing import Card, along, blend, field, save_bark, bark_plates

os.chdir(os.path.dirname(os.path.abspath(__file__)))
draw = random.Random(61)


def shoot(card, place, direction, length, bend):
    """A shoot with long needles in pairs on its outer part."""
    steps = round(length / 0.014)
    heading = direction
    places = [place]
    for i in range(steps):
        heading += bend / steps
        places.append(along(places[-1], heading, length / steps))
    card.line(places, 0.016, (140, 98, 62))
    for i, at in enumerate(places):
        t = i / steps
        if t < 0.35:
            continue
        for side in (-1, 1):
            lean = draw.uniform(22, 62) * (1.1 - 0.7 * t)
            tone = draw.uniform(0.68, 1.2)
            card.line([at, along(at, heading + side * lean, draw.uniform(0.08, 0.125))], 0.0042,
                      (88 * tone, 114 * tone, 88 * tone))


card = Card(448, 512)
for start, direction, length, bend in ((0.06, -58, 0.38, 30), (0.1, 56, 0.4, -30), (0.3, -42, 0.36, 24),
                                       (0.36, 46, 0.34, -26), (0.5, -26, 0.3, 10), (0.52, 30, 0.3, -12)):
    shoot(card, (0, start), direction, length, bend)
shoot(card, (0, 0), 0, 0.84, 4)
card.save("spray.png", levels=16)

edge, number = bark_plates(512, 90, 2.6, 62)
fine = field(512, 1.5, 3, 63)
height = edge**0.7 * (0.7 + 0.3 * number)
plates = blend((126, 100, 84), (100, 84, 76), number) * (1 + 0.09 * fine)[..., None]
part = np.clip(edge * 1.3, 0, 1)[..., None]
save_bark("base.jpg", np.array((52, 36, 29)) * (1 - part) + plates * part, height, 4.0)

flake = np.clip((field(512, 14, 18, 64) + 0.5 * field(512, 5, 7, 65)) * 0.5 + 0.5, 0, 1)
curl = np.clip(np.abs(field(512, 10, 14, 66)) / 0.25, 0, 1)
orange = blend((150, 84, 52), (192, 126, 86), flake) * (0.82 + 0.18 * curl + 0.05 * fine)[..., None]
save_bark("bark.jpg", orange, 0.6 * curl + 0.4 * flake, 2.5)
# Plates between orange scales, for the trunk between its base and the crown.
last = np.clip((field(512, 16, 40, 67) + 0.4 * field(512, 6, 9, 68)) * 4 + 0.5, 0, 1)[..., None]
lower = np.array((52, 36, 29)) * (1 - part) + plates * part
save_bark("middle.jpg", orange * 0.92 * (1 - last) + lower * last)
