#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Draws the pictures of norway-maple.lsys: bark.jpg and its normals, spray.png (a twig with pointed, palmate leaves)
and twig.png (the same without leaves).
Usage: samples/species/norway-maple/pictures.py      Needs Pillow and NumPy (Debian: python3-pil, python3-numpy)."""
import os
import random
import sys

import numpy as np

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
from drawing import Card, along, blend, field, save_bark, shaded

os.chdir(os.path.dirname(os.path.abspath(__file__)))
draw = random.Random(19)

# The right half of a leaf of five lobes with long teeth, from the stalk to the tip; the base lies at (0, 0).
HALF = [(0, 0), (0.1, -0.09), (0.17, -0.1), (0.3, -0.14), (0.27, -0.03), (0.42, -0.02), (0.33, 0.08), (0.34, 0.16),
        (0.47, 0.2), (0.6, 0.34), (0.44, 0.34), (0.46, 0.5), (0.33, 0.42), (0.2, 0.38), (0.17, 0.52), (0.28, 0.66),
        (0.14, 0.66), (0.11, 0.8), (0, 1)]


def palmate(card, place, direction, length, colour, vein):
    """A leaf on a long stalk."""
    base = along(place, direction, 0.55 * length)
    card.line([place, base], 0.03 * length, (188, 130, 104))
    right = [along(base, direction, y * length, x * length) for x, y in HALF]
    left = [along(base, direction, y * length, -x * length) for x, y in HALF]
    card.fill_polygon(right + left[::-1], colour)
    card.fill_polygon(right, shaded(colour, 0.92))
    card.line(right + left[::-1], 0.014 * length, shaded(colour, 0.66))
    for x, y in ((0, 0.95), (0.52, 0.3), (-0.52, 0.3), (0.36, -0.04), (-0.36, -0.04)):
        card.line([base, along(base, direction, y * length, x * length)], 0.016 * length, vein)


def leafy(card, place, direction, length, bend, leaves):
    """A twig with pairs of leaves."""
    steps = max(2, round(length / 0.13))
    heading = direction
    for i in range(steps):
        ahead = along(place, heading, length / steps)
        card.line([place, ahead], 0.011 if leaves else 0.017, (126, 102, 84))
        place = ahead
        heading += bend / steps
        for side in (-1, 1):
            if not leaves:
                card.line([place, along(place, heading + side * 36, 0.05)], 0.013, (126, 96, 78))
                continue
            tone = draw.uniform(0.76, 1)
            hue = draw.uniform(-10, 10)
            palmate(card, place, heading + side * draw.uniform(30, 75), draw.uniform(0.125, 0.165),
                    ((214 + hue) * tone, 222 * tone, (188 - hue) * tone), (242 * tone, 244 * tone, 204 * tone))
    if leaves:
        palmate(card, place, heading, 0.13, (206, 216, 182), (240, 242, 204))


for name, leaves in (("spray.png", True), ("twig.png", False)):
    card = Card(512, 512)
    for start, direction, length, bend in ((0.05, -56, 0.36, 34), (0.06, 58, 0.36, -34), (0.3, -46, 0.32, 28),
                                           (0.31, 46, 0.32, -28), (0.52, -38, 0.18, 20), (0.53, 38, 0.18, -20)):
        leafy(card, (0, start), direction, length, bend, leaves)
    leafy(card, (0, 0), 0, 0.74, 3, leaves)
    card.save(name, levels=16)

size = 512
crack = np.clip(np.abs(field(size, 5, 22, 21) + 0.5 * field(size, 5, 9, 22)) / 0.55, 0, 1)
rough = field(size, 1.3, 3, 23)
save_bark("bark.jpg", blend((70, 62, 54), (138, 128, 116), crack**0.7) * (1 + 0.07 * rough)[..., None], crack, 2.5)
