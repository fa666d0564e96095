#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Draws the pictures of weeping-willow.lsys: bark.jpg and its normals, spray.png (a piece of a hanging twig) and
twig.png (the same without leaves).
Usage: samples/species/weeping-willow/pictures.py      Needs Pillow and NumPy (Debian: python3-pil, python3-numpy)."""
import os
import random
import sys

import numpy as np

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
from drawing import Card, along, blend, field, leaf, save_bark

os.chdir(os.path.dirname(os.path.abspath(__file__)))
draw = random.Random(17)
LANCE = [(0, 0), (0.08, 0.045), (0.25, 0.075), (0.45, 0.078), (0.65, 0.058), (0.85, 0.024), (1, 0)]


def draw_twig(card, place, direction, length, leaves):
    """A thin yellow twig with narrow leaves by turns to either side, which hang. It strays little from `direction`."""
    steps = round(length / 0.036)
    heading = direction
    for i in range(steps):
        heading += draw.uniform(-3, 3) - 0.12 * heading
        ahead = along(place, heading, length / steps)
        card.line([place, ahead], 0.011 if leaves else 0.013, (176, 152, 84))
        place = ahead
        if not leaves:
            continue
        tone = draw.uniform(0.72, 1)
        hue = draw.uniform(-8, 8)
        leaf(card, place, heading + (1 if i % 2 else -1) * draw.uniform(14, 42), draw.uniform(0.1, 0.15), LANCE,
             ((214 + hue) * tone, 224 * tone, (196 - hue) * tone), (240 * tone, 244 * tone, 220 * tone), veins=0,
             stalk=0.06)


for name, leaves in (("spray.png", True), ("twig.png", False)):
    card = Card(224, 512)
    # The middle twig reaches from end to end, so that pieces in a row show no gaps.
    for angle, start, length in ((0, 0, 1), (-18, 0.1, 0.62), (20, 0.11, 0.74)):
        draw_twig(card, (0, start), angle, length, leaves)
    card.save(name, levels=24)

size = 512
crack = np.clip(np.abs(field(size, 11, 30, 31) + 0.6 * field(size, 9, 16, 32)) / 0.7, 0, 1)
rough = field(size, 1.3, 3, 33)
save_bark("bark.jpg", blend((52, 45, 36), (150, 138, 116), crack**0.8) * (1 + 0.09 * rough)[..., None], crack, 5.0)
