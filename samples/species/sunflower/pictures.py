#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Draws the pictures of sunflower.lsys: leaf.png, and ray.png, a floret of the margin of the head.
Usage: samples/species/sunflower/pictures.py      Needs Pillow and NumPy (Debian: python3-pil, python3-numpy)."""
import math
import os
import random
import sys

import numpy as np
from PIL import Image

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
from drawing import Card, along

os.chdir(os.path.dirname(os.path.abspath(__file__)))
draw = random.Random(2)

# Half of a leaf, a heart: (x, y) from the stalk to the tip.
HEART = [(0, 0.1), (0.06, 0.03), (0.16, 0), (0.27, 0.04), (0.36, 0.13), (0.4, 0.25), (0.39, 0.38), (0.34, 0.52),
         (0.26, 0.66), (0.17, 0.8), (0.08, 0.92), (0, 1)]


def heart():
    """The outline with flat teeth."""
    path = [math.dist(a, b) for a, b in zip(HEART, HEART[1:])]
    at = np.concatenate([[0], np.cumsum(path)])
    places = []
    for i in range(57):
        s = at[-1] * i / 56
        x, y = np.interp(s, at, [p[0] for p in HEART]), np.interp(s, at, [p[1] for p in HEART])
        places.append((x * (1.02 if i % 2 else 0.96) if 4 < i < 55 else x, y))
    return places


card = Card(448, 512)
right = heart()
green, vein = (206, 214, 188), (240, 244, 216)
card.fill_polygon(right + [(-x, y) for x, y in right[::-1]], green)
card.fill_polygon(right + [(0, 0)], tuple(0.92 * part for part in green))
inside = card.image.copy()


def veins(place, direction, length, width, order, bend):
    """A vein with branches towards the margin."""
    steps = 10
    heading = direction
    places = [place]
    for i in range(steps):
        heading += bend / steps
        places.append(along(places[-1], heading, length / steps))
    if order < 2:
        for i in range(1, steps):
            t = i / steps
            for side in (-1, 1):
                reach = length * (0.52 if order == 0 else 0.3) * math.sin(math.pi * min(1, 0.18 + 0.85 * t)) ** 0.8
                veins(places[i], heading * t + direction * (1 - t) + side * 48, reach, width * 0.45, order + 1,
                      -side * 16)
    card.line(places, width, vein if order < 2 else (224, 230, 202))


veins((0, 0.1), 0, 0.88, 0.016, 0, 0)
for side in (-1, 1):
    veins((0, 0.11), side * 40, 0.56, 0.012, 1, -side * 34)
# Veins beyond the margin are cut off.
pixels, mask = np.asarray(card.image).copy(), np.asarray(inside)
pixels[mask[..., 3] == 0] = 0
card.image = Image.fromarray(pixels, "RGBA")
card.save("leaf.png", levels=24)

card = Card(144, 512)
shape = [(0, 0.03), (0.06, 0.05), (0.2, 0.1), (0.4, 0.125), (0.6, 0.12), (0.78, 0.092), (0.9, 0.055), (0.97, 0.022), (1, 0)]
outline = [(w, t) for t, w in shape]
card.fill_polygon(outline + [(-x, y) for x, y in outline[::-1]], (255, 206, 30))
for i in range(9):
    part = (i - 4) / 4.6
    line = [(w * part, t) for t, w in shape[:-2]]
    card.line(line, 0.006, (238, 172, 12) if i % 2 == 0 else (255, 222, 70))
card.fill_polygon([(0.035, 0), (0.05, 0.07), (0, 0.2), (-0.05, 0.07), (-0.035, 0)], (232, 150, 10))
card.save("ray.png")
