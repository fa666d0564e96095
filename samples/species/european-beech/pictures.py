#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Draws the pictures of european-beech.lsys: bark.jpg (smooth and grey), spray.png (a level twig with leaves) and
twig.png (the same without leaves).
Usage: samples/species/european-beech/pictures.py      Needs Pillow and NumPy (Debian: python3-pil, python3-numpy)."""
import os
import random
import sys

import numpy as np

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
from drawing import Card, along, blend, field, leaf, save_bark

os.chdir(os.path.dirname(os.path.abspath(__file__)))
draw = random.Random(71)
# Half of a leaf: an egg with waves between the veins.
EGG = [(0, 0.02), (0.08, 0.16), (0.2, 0.27), (0.38, 0.33), (0.55, 0.31), (0.72, 0.22), (0.87, 0.1), (1, 0)]


def waved():
    outline = []
    for i in range(41):
        t = i / 40
        half = float(np.interp(t, [p for p, _ in EGG], [w for _, w in EGG]))
        outline.append((t, half * (1 + 0.035 * np.sin(2 * np.pi * 7 * t))))
    return outline


def leafy(card, place, direction, length, bend, leaves):
    """A zigzag twig with leaves by turns to either side, in one plane, and a slender bud at its end."""
    steps = max(2, round(length / 0.062))
    heading = direction
    for i in range(steps):
        ahead = along(place, heading + (9 if i % 2 else -9), length / steps)
        card.line([place, ahead], 0.009 if leaves else 0.015, (118, 100, 84))
        place = ahead
        heading += bend / steps
        side = 1 if i % 2 else -1
        if not leaves:
            card.line([place, along(place, heading + side * 40, 0.045)], 0.012, (150, 104, 66))
            continue
        tone = draw.uniform(0.76, 1)
        hue = draw.uniform(-10, 10)
        leaf(card, place, heading + side * draw.uniform(42, 62), draw.uniform(0.088, 0.115), waved(),
             ((214 + hue) * tone, 224 * tone, (190 - hue) * tone), (240 * tone, 244 * tone, 208 * tone), veins=7,
             vein_angle=46, stalk=0.1)
    if leaves:
        leaf(card, place, heading, 0.105, waved(), (206, 216, 184), (238, 242, 206), veins=7, vein_angle=46)


for name, leaves in (("spray.png", True), ("twig.png", False)):
    card = Card(512, 512)
    for start, direction, length, bend in ((0.04, -62, 0.38, 26), (0.1, 60, 0.4, -26), (0.18, -58, 0.4, 24),
                                           (0.26, 56, 0.38, -24), (0.34, -52, 0.34, 22), (0.42, 50, 0.3, -22),
                                           (0.52, -46, 0.24, 20), (0.6, 44, 0.2, -20)):
        leafy(card, (0, start), direction, length, bend, leaves)
    leafy(card, (0, 0), 0, 0.82, 4, leaves)
    card.save(name, levels=16)

# Smooth bark: wide patches of little contrast without a direction, a fine grain, and grey-green lichen. Bands that lie
# across the trunk would look like stripes from afar.
size = 512
tone = 0.55 + 0.09 * field(size, 44, 60, 72) + 0.05 * field(size, 9, 9, 75) + 0.05 * field(size, 3, 1.2, 73)
lichen = np.clip((field(size, 16, 18, 74) - 1.1) * 0.6, 0, 0.4)
colours = blend((112, 114, 110), (166, 168, 162), tone)
colours = colours * (1 - lichen)[..., None] + np.array((142, 150, 128)) * lichen[..., None]
save_bark("bark.jpg", colours)
