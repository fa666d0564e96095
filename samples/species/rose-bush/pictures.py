#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Draws the pictures of rose-bush.lsys: flower.png (a flower, a bud and stamens) and leaves.png (two leaves).
Usage: samples/species/rose-bush/pictures.py      Needs Pillow and NumPy (Debian: python3-pil, python3-numpy)."""
import os
import random
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
from drawing import Card, along, flower, leaf, toothed

os.chdir(os.path.dirname(os.path.abspath(__file__)))
draw = random.Random(47)

PETAL = [(0, 0.04), (0.12, 0.12), (0.3, 0.27), (0.5, 0.42), (0.68, 0.5), (0.82, 0.49), (0.92, 0.38),
         (0.985, 0.22), (1, 0.13), (0.975, 0.05), (0.945, 0)]
COLOURS = ((252, 248, 244), (250, 222, 230), (240, 168, 192), (214, 206, 96))
LEAFLET = toothed([(0, 0.02), (0.1, 0.17), (0.25, 0.27), (0.42, 0.3), (0.62, 0.25), (0.8, 0.15), (0.93, 0.05), (1, 0)],
                  15, 0.014)

# Left the petals of a flower, in the middle its stamens alone, right a bud above a patch of the colour of stalks.
card = Card(640, 256)
flower(card, (-0.75, 0.5), 0.49, 0, PETAL, COLOURS, (0, 0, None, None), 1, 0, draw)
middle = (0.25, 0.5)
for count, reach in ((34, 0.46), (30, 0.36), (22, 0.25)):
    for k in range(count):
        way, length = 360 * k / count + draw.uniform(-5, 5), reach * draw.uniform(0.8, 1)
        end = along(middle, way, length)
        card.line([along(middle, way, 0.1), end], 0.016, (246, 226, 130))
        card.fill_polygon([along(end, 45 * j, 0.034 if j % 4 else 0.05) for j in range(8)],
                  draw.choice(((236, 182, 36), (222, 160, 28))))
card.fill_polygon([along(middle, 30 * j, 0.11) for j in range(12)], (206, 204, 96))
for w, colour in ((0.2, (222, 110, 146)), (0.13, (236, 144, 174)), (0.05, (246, 186, 204))):
    card.fill_polygon([(1 + x * w, y) for x, y in ((-0.5, 0.42), (-1, 0.56), (-0.95, 0.74), (-0.4, 0.93), (0.2, 0.96),
                                           (0.9, 0.78), (1, 0.58), (0.5, 0.42))], colour)
for x in (-0.19, 0, 0.19):
    card.fill_polygon([(1 + 0.5 * x - 0.06, 0.4), (1 + 0.5 * x + 0.06, 0.4), (1 + 1.2 * x, 0.74 - abs(x))], (112, 146, 72))
card.fill_polygon([(0.87, 0.4), (1.13, 0.4), (1.06, 0.28), (0.94, 0.28)], (112, 146, 72))
card.fill_polygon([(0.8, 0.02), (1.2, 0.02), (1.2, 0.18), (0.8, 0.18)], (128, 150, 76))
card.save("flower.png", levels=32)

# Two pinnate leaves, of seven and five leaflets.
card = Card(512, 384)
for x, pairs in ((-0.333, 3), (0.333, 2)):
    card.line([(x, 0), (x, 0.62)], 0.012, (220, 222, 176))
    card.fill_polygon([(x - 0.008, 0), (x + 0.008, 0), (x + 0.035, 0.14), (x + 0.01, 0.11), (x - 0.01, 0.11), (x - 0.035, 0.14)],
              (214, 224, 182))
    for i in range(pairs):
        y = 0.2 + (0.42 / pairs) * (i + (0.1 if pairs == 3 else 0.25))
        for side in (-1, 1):
            tone = draw.uniform(0.84, 1)
            leaf(card, (x, y), side * draw.uniform(58, 70), draw.uniform(0.27, 0.3) * (1 if i else 0.9), LEAFLET,
                 (210 * tone, 224 * tone, 190 * tone), (242 * tone, 246 * tone, 212 * tone), 6, 42, 0.05)
    leaf(card, (x, 0.61), draw.uniform(-4, 4), 0.36, LEAFLET, (212, 226, 192), (244, 248, 214), 7, 42, 0.05)
card.save("leaves.png", levels=20)
