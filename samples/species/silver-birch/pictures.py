#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Draws the pictures of silver-birch.lsys: bark.jpg, base.jpg and its normals, middle.jpg (the bark between them),
spray.png (a hanging twig with leaves) and twig.png (the same without leaves).
Usage: samples/species/silver-birch/pictures.py      Needs Pillow and NumPy (Debian: python3-pil, python3-numpy)."""
import math
import os
import random
import sys

import numpy as np

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
from drawing import Card, along, blend, field, leaf, save_bark

os.chdir(os.path.dirname(os.path.abspath(__file__)))
draw = random.Random(11)

# Half of a leaf: a rhomb with a broad base, a long tip and double teeth.
SHAPE = [(0, 0), (0.03, 0.1), (0.12, 0.27),
         (0.22, 0.36), (0.29, 0.37), (0.42, 0.28), (0.58, 0.18), (0.75, 0.09), (0.9, 0.03), (1, 0)]


def toothed():
    outline = []
    for i in range(33):
        t = i / 32
        half = float(np.interp(t, [p for p, _ in SHAPE], [w for _, w in SHAPE]))
        outline.append((t, half * (1.05 if i % 2 else 0.93)))
    return outline


def leafy(card, place, direction, length, bend, leaves):
    """A twig with a leaf by turns to each side, or without; its tip turns by `bend` degrees."""
    steps = max(3, round(length / 0.055))
    heading = direction
    for i in range(steps):
        ahead = along(place, heading, length / steps)
        card.line([place, ahead], 0.008 if leaves else 0.014, (104, 78, 66))
        place = ahead
        heading += bend / steps + draw.uniform(-9, 9)
        if not leaves:
            continue
        side = 1 if i % 2 else -1
        tone = draw.uniform(0.72, 1.0)
        hue = draw.uniform(-12, 12)
        leaf(card, place, heading + side * draw.uniform(25, 70), draw.uniform(0.085, 0.12), toothed(),
             ((216 + hue) * tone, 222 * tone, (196 - hue) * tone), (238 * tone, 240 * tone, 214 * tone),
             veins=6, vein_angle=42, stalk=0.35)


for name, leaves in (("spray.png", True), ("twig.png", False)):
    card = Card(384, 512)
    leafy(card, (0, 0), 0, 0.86, 8, leaves)
    for start, direction, length, bend in ((0.05, -62, 0.42, 50), (0.14, 58, 0.46, -48), (0.3, -50, 0.42, 45),
                                           (0.4, 46, 0.38, -40), (0.55, -42, 0.3, 40), (0.63, 44, 0.24, -40)):
        leafy(card, (0, start), direction, length, bend, leaves)
    card.save(name)

size = 512
white = blend((240, 236, 228), (222, 212, 202), 0.5 + 0.28 * field(size, 30, 18, 1))
white = white + 4 * field(size, 6, 0.8, 2)[..., None]
peel = np.clip(field(size, 26, 1.4, 3) - 1.7, 0, 0.6) / 0.6
dark = np.clip(field(size, 9, 0.9, 4) - 1.9, 0, 0.25) / 0.25
y, x = np.mgrid[0:size, 0:size]
wobble = field(size, 7, 5, 6)
spots = np.random.default_rng(9)
for _ in range(9):
    px, py, wide, high = spots.random() * size, spots.random() * size, spots.uniform(26, 60), spots.uniform(11, 26)
    dx = np.abs((x - px + size / 2) % size - size / 2)
    dy = (y - py + size / 2) % size - size / 2
    dark = np.maximum(dark, np.clip((1.15 - dx / wide - np.abs(dy) / high + 0.22 * wobble) * 5, 0, 1))
colours = white * (1 - 0.22 * peel)[..., None]
colours = colours * (1 - dark)[..., None] + np.array((38, 33, 31)) * dark[..., None]
save_bark("bark.jpg", colours)

ridge = np.clip(np.abs(field(size, 9, 34, 12) + 0.35 * field(size, 5, 7, 14)) / 0.8, 0, 1)
rough = field(size, 1.5, 3, 13)
pale = np.clip((field(size, 24, 18, 15) - 0.75) * 3, 0, 1) * ridge
base = blend((34, 30, 28), (104, 96, 88), ridge) * (1 + 0.1 * rough)[..., None]
save_bark("base.jpg", base * (1 - pale)[..., None] + np.array((222, 214, 204)) * pale[..., None], ridge, 5.0)
# Cracks that end in the white bark, for the trunk above its base.
gap = np.clip((field(size, 12, 46, 16) + 0.35 * field(size, 5, 9, 17) - 0.15) * 4, 0, 1)[..., None]
save_bark("middle.jpg", colours * (1 - gap) + base * gap)
