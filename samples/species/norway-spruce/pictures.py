#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Draws the pictures of norway-spruce.lsys: bark.jpg, bark-normals.jpg, and spray.png, a branchlet with needles.
Usage: samples/species/norway-spruce/pictures.py      Needs Pillow and NumPy (Debian: python3-pil, python3-numpy)."""
import os
import random
import sys

import numpy as np

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
from drawing import Card, along, blend, field, save_bark, bark_plates

os.chdir(os.path.dirname(os.path.abspath(__file__)))
draw = random.Random(7)


def shoot(card, place, direction, length, green):
    """A twig with needles on all sides; needles at its end point forwards."""
    bend = draw.uniform(-14, 14)
    steps = max(4, int(length / 0.0065))
    points = [place]
    for i in range(steps):
        points.append(along(points[-1], direction + bend * i / steps, length / steps))
    card.line(points, 0.006, (112, 84, 58))
    for i, point in enumerate(points):
        t = i / steps
        heading = direction + bend * t
        for side in (-1, 1):
            lean = draw.uniform(42, 66) * (1 - 0.55 * t**4)
            tone = draw.uniform(0.75, 1.15)
            end = along(point, heading + side * lean, draw.uniform(0.020, 0.030))
            card.line([point, end], 0.005, tuple(tone * part for part in green))
        if i % 2 == 0:
            end = along(point, heading + draw.uniform(-20, 20), draw.uniform(0.014, 0.022))
            card.line([point, end], 0.005, tuple(draw.uniform(0.9, 1.25) * part for part in green))


card = Card(320, 512)
card.line([(0, 0), (0, 0.9)], 0.012, (105, 78, 54))
green = (62, 88, 54)
for i in range(12):
    y = 0.04 + 0.072 * i
    reach = (0.06 + 0.30 * (1 - y) ** 0.75) * min(1, 0.55 + 1.6 * y)
    for side in (-1, 1):
        start = (0, y + draw.uniform(-0.025, 0.025))
        angle = side * draw.uniform(46, 58)
        shoot(card, start, angle, reach * draw.uniform(0.65, 1.1), green)
        if reach > 0.17:
            for part in (0.35, 0.62):
                place = along(start, angle, reach * part)
                shoot(card, place, angle + draw.choice((-1, 1)) * 38, reach * 0.35, green)
shoot(card, (0, 0.05), 0, 0.9, green)
card.save("spray.png", levels=24)

# Thin scales of two sizes, one over the other; a relief of plates alone would look like cobble stones.
size = 512
small, small_number = bark_plates(size, 1500, 2.0, 3)
large, large_number = bark_plates(size, 420, 2.4, 13)
fine, patch, streak = field(size, 1.2, 2.5, 5), field(size, 26, 60, 6), field(size, 5, 40, 7)
small, large = np.clip(1.8 * small, 0, 1), np.clip(1.6 * large, 0, 1)
height = (0.45 * large**0.7 * (0.6 + 0.4 * large_number) + 0.35 * small**0.7 * (0.5 + 0.5 * small_number)
          + 0.06 * fine + 0.12 * streak)
scales = blend((122, 92, 75), (160, 130, 108),
               0.45 * small_number + 0.35 * large_number + 0.12 * patch + 0.1 * streak)
gaps = (1 - 0.36 * (1 - small)**1.2) * (1 - 0.45 * (1 - large)**1.6) * (1 + 0.06 * fine)
save_bark("bark.jpg", scales * gaps[..., None], height, 2.2)
