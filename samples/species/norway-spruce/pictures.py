#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Draws the pictures of norway-spruce.lsys: bark.jpg, bark-normals.jpg, and spray.png, a branchlet with needles.
Usage: samples/species/norway-spruce/pictures.py      Needs Pillow and NumPy (Debian: python3-pil, python3-numpy)."""
import os
import random
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
from drawing import Card, along, blend, field, save_bark, bark_plates

os.chdir(os.path.dirname(os.path.abspath(__file__)))
draw = random.Random(7)


def shoot(card, place, direction, length, green):
    """A twig with needles on all sides; those of the end point forwards."""
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

edge, number = bark_plates(512, 260, 1.5, 3)
fine = field(512, 1.2, 2.5, 5)
height = edge**0.6 * (0.75 + 0.25 * number)
plates = blend((150, 112, 88), (118, 92, 78), number) * (1 + 0.07 * fine)[..., None]
save_bark("bark.jpg", blend((66, 44, 36), (0, 0, 0), height * 0) * (1 - edge**0.5)[..., None]
          + plates * (edge**0.5)[..., None], height, 3.0)
