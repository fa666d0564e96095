#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Draws the pictures of apple.lsys: bark.jpg and its normals, blossom.png (spurs with flowers), leaves.png (spurs with
leaves) and twig.png (a bare twig).
Usage: samples/species/apple/pictures.py      Needs Pillow and NumPy (Debian: python3-pil, python3-numpy)."""
import os
import random
import sys

import numpy as np

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
from drawing import Card, along, blend, field, flower, leaf, save_bark, bark_plates, shaded, toothed

os.chdir(os.path.dirname(os.path.abspath(__file__)))
draw = random.Random(31)

PETAL = [(0, 0.03), (0.12, 0.07), (0.28, 0.2), (0.45, 0.31), (0.62, 0.36), (0.78, 0.34), (0.9, 0.24), (0.97, 0.1),
         (1, 0)]
WHITE = ((238, 246, 222), (255, 250, 250), (252, 226, 233), (206, 214, 132))
PINK = ((250, 226, 232), (252, 226, 234), (243, 182, 202), (206, 214, 132))
STAMENS = (18, 0.4, (244, 246, 226), (214, 166, 40))
LEAF = [(0, 0.02), (0.1, 0.14), (0.25, 0.24), (0.45, 0.29), (0.65, 0.25), (0.82, 0.15), (0.94, 0.05), (1, 0)]
EDGE = toothed(LEAF, 13, 0.012)


def green(young):
    """Colours of a blade and its veins."""
    tone = draw.uniform(0.8, 1)
    if young:
        hue = draw.uniform(-12, 12)
        return ((128 + hue) * tone, 166 * tone, 62 * tone), (186 * tone, 206 * tone, 118 * tone)
    hue = draw.uniform(-10, 10)
    return ((212 + hue) * tone, 224 * tone, (186 - hue) * tone), (240 * tone, 244 * tone, 208 * tone)


def bud(card, place, direction, size):
    """A closed flower: pink petals above green sepals."""
    top = along(place, direction, size)
    for w, colour in ((0.36, (226, 120, 152)), (0.22, (240, 158, 182)), (0.08, (248, 192, 206))):
        card.fill_polygon([along(place, direction, t * size, s * w * size * k)
                   for s, ts in ((1, (0.1, 0.35, 0.7, 0.95, 1.02)), (-1, (1.02, 0.95, 0.7, 0.35, 0.1)))
                   for t, k in zip(ts, (0.5, 1, 0.95, 0.4, 0.05)[::s])], colour)
    card.fill_polygon([along(place, direction, -0.1 * size), along(place, direction, 0.3 * size, 0.32 * size),
               along(place, direction, 0.24 * size), along(place, direction, 0.3 * size, -0.32 * size)], (120, 150, 84))


def stalk(card):
    """A patch of the colour of bark between two pictures."""
    card.fill_polygon([(-0.018, 0), (0.018, 0), (0.018, 0.09), (-0.018, 0.09)], (112, 92, 78))


def rosette(card, middle):
    """Young leaves of a spur with flowers, seen from its tip."""
    start = draw.uniform(0, 360)
    for k in range(9):
        blade, vein = green(True)
        reach = 0.46 * (draw.uniform(0.8, 1) if k < 6 else draw.uniform(0.5, 0.7))
        leaf(card, middle, start + 137.5 * k + draw.uniform(-14, 14), reach, EDGE, blade, vein, 6, 42, 0.14)


def truss(card, middle, size):
    """A cluster of flowers and buds, about `size` wide, seen from its tip."""
    start = draw.uniform(0, 360)
    for k in range(2):
        away = start + 36 + 144 * k + draw.uniform(-10, 10)
        bud(card, along(middle, away, 0.4 * size), away + draw.uniform(-30, 30), 0.15 * size)
    places = [(along(middle, start + 72 * k + draw.uniform(-9, 9), draw.uniform(0.27, 0.32) * size), start + 72 * k)
              for k in range(5)] + [(middle, 0)]
    for spot, slant in places:
        flower(card, spot, size * draw.uniform(0.19, 0.21), draw.uniform(0, 72), PETAL,
               PINK if draw.random() < 0.25 else WHITE, STAMENS, draw.uniform(0.8, 1), slant, draw)


# blossom.png and leaves.png: two spurs side by side in each picture, seen from their tips.
card = Card(512, 256)
for x in (-0.5, 0.5):
    rosette(card, (x, 0.5))
    truss(card, (x, 0.5), 0.7)
stalk(card)
card.save("blossom.png", levels=24)
card = Card(512, 256)
for x in (-0.5, 0.5):
    start = draw.uniform(0, 360)
    for k in range(13):
        blade, vein = green(False)
        away = start + 137.5 * k
        spot = along((x, 0.5), away, (0.27, 0.2, 0.12, 0.04)[min(k // 4, 3)] * draw.uniform(0.85, 1.1))
        card.line([(x, 0.5), spot], 0.01, vein)
        leaf(card, spot, away + draw.uniform(-55, 55), draw.uniform(0.19, 0.25), EDGE, blade, vein, 6, 42, 0.15)
stalk(card)
card.save("leaves.png", levels=24)

card = Card(384, 384)
for start, direction, length, bend in ((0.05, -50, 0.4, 34), (0.1, 54, 0.4, -34), (0.38, -44, 0.32, 26),
                                       (0.42, 46, 0.3, -26), (0, 0, 0.92, 3)):
    place, heading, steps = (0, start), direction, round(length / 0.08)
    for i in range(steps):
        ahead = along(place, heading, length / steps)
        card.line([place, ahead], 0.018, (112, 92, 78))
        place = ahead
        heading += bend / steps
        end = along(place, heading + (1 if i % 2 else -1) * draw.uniform(40, 80), draw.uniform(0.015, 0.045))
        card.line([place, end], 0.016, (118, 92, 76))
        card.fill_polygon([along(end, 51 * j, 0.011) for j in range(7)], (138, 108, 94))
card.save("twig.png", levels=16)

size = 512
edge, number = bark_plates(size, 110, 1.7, 32)
rough = field(size, 1.5, 2.5, 33)
moss = np.clip(field(size, 40, 60, 34) - 0.6, 0, 1)
colour = blend((66, 56, 48), (134, 120, 106), edge**0.6) * (0.88 + 0.24 * number + 0.06 * rough)[..., None]
moss = 0.35 * moss[..., None]
save_bark("bark.jpg", colour * (1 - moss) + moss * np.array((116, 124, 92)), edge, 2.2)
