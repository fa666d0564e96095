#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Draws spray.png, a twig of bamboo.lsys with a fan of leaves.
Usage: samples/species/bamboo/pictures.py      Needs Pillow and NumPy (Debian: python3-pil, python3-numpy)."""
import os
import random
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
from drawing import Card, along, leaf

os.chdir(os.path.dirname(os.path.abspath(__file__)))
draw = random.Random(8)
BLADE = [(0, 0.01), (0.05, 0.05), (0.18, 0.085), (0.35, 0.09), (0.6, 0.065), (0.82, 0.03), (1, 0)]
card = Card(448, 512)


def fan(place, direction, length):
    end = along(place, direction, length)
    card.line([place, end], 0.008, (176, 184, 110))
    # Leaves stand by turns in two rows; the last continues the twig.
    for i, part in enumerate((0.25, 0.45, 0.6, 0.75, 0.88, 1)):
        tone = draw.uniform(0.74, 1)
        angle = 0 if part == 1 else (62 - 40 * part) * (1 if i % 2 else -1)
        leaf(card, along(place, direction, length * part), direction + angle + draw.uniform(-8, 8),
             draw.uniform(0.2, 0.29), BLADE, (212 * tone, 226 * tone, 180 * tone), (238, 244, 206), veins=0, stalk=0.03)


for start, direction, length in ((0.02, -52, 0.26), (0.06, 50, 0.28), (0.3, -40, 0.22), (0.36, 44, 0.2)):
    fan((0, start), direction, length)
card.line([(0, 0), (0, 0.6)], 0.011, (168, 178, 100))
fan((0, 0.5), 0, 0.18)
card.save("spray.png", levels=20)
