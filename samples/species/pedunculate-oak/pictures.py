#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Draws the pictures of pedunculate-oak.lsys: bark.jpg and its normals, spray.png (a twig with lobed leaves) and
twig.png (the same without leaves).
Usage: samples/species/pedunculate-oak/pictures.py      Needs Pillow and NumPy (Debian: python3-pil, python3-numpy)."""
import math
import os
import random
import sys

import numpy as np

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
from drawing import Card, along, blend, field, leaf, save_bark

os.chdir(os.path.dirname(os.path.abspath(__file__)))
draw = random.Random(5)

# Half of a leaf: the envelope is broadest beyond the middle; five round lobes, and ears at the base.
ENVELOPE = [(0, 0.06), (0.1, 0.14), (0.3, 0.22), (0.55, 0.31), (0.72, 0.31), (0.88, 0.22), (1, 0.02)]


def lobed_outline():
    outline = [(0, 0.0), (0.01, 0.07), (0.05, 0.08)]
    for i in range(4, 61):
        t = i / 60
        half = float(np.interp(t, [p for p, _ in ENVELOPE], [w for _, w in ENVELOPE]))
        wave = abs(math.cos(math.pi * (4.6 * t + 0.55))) ** 0.7
        outline.append((t, half * (0.3 + 0.74 * wave) if t < 0.97 else half))
    return outline + [(1, 0)]


def leafy(card, place, direction, length, bend, leaves):
    """A twig with few leaves along it and a cluster at its end, or without leaves."""
    steps = max(2, round(length / 0.12))
    heading = direction
    for i in range(steps):
        ahead = along(place, heading, length / steps)
        card.line([place, ahead], 0.012 if leaves else 0.018, (112, 98, 84))
        place = ahead
        heading += bend / steps + draw.uniform(-9, 9)
        last = i == steps - 1
        for angle in ((-84, -42, 0, 42, 84) if last else (draw.choice((-62, 62)),)):
            if not leaves:
                card.line([place, along(place, heading + 0.6 * angle, draw.uniform(0.05, 0.16))], 0.011, (124, 106, 90))
                continue
            tone = draw.uniform(0.74, 1.0)
            hue = draw.uniform(-10, 10)
            leaf(card, place, heading + angle + draw.uniform(-12, 12), draw.uniform(0.14, 0.175), lobed_outline(),
                 ((218 + hue) * tone, 224 * tone, (190 - hue) * tone), (240 * tone, 242 * tone, 206 * tone),
                 veins=5, vein_angle=48, stalk=0.03)


for name, leaves in (("spray.png", True), ("twig.png", False)):
    card = Card(512, 512)
    for start, direction, length, bend in ((0.05, -66, 0.38, 24), (0.1, 64, 0.4, -24), (0.32, -58, 0.36, 30),
                                           (0.4, 58, 0.32, -30), (0.58, -46, 0.22, 25), (0.64, 46, 0.2, -25)):
        leafy(card, (0, start), direction, length, bend, leaves)
    leafy(card, (0, 0), 0, 0.86, 6, leaves)
    card.save(name, levels=16)

size = 512
crack = np.clip(np.abs(field(size, 8, 42, 21) + 0.5 * field(size, 6, 12, 22)) / 0.75, 0, 1)
across = np.clip(np.abs(field(size, 14, 9, 25)) / 0.3, 0.35, 1)
ridge = crack**0.8 * (0.6 + 0.4 * across)
rough = field(size, 1.3, 3, 23)
moss = np.clip((field(size, 40, 50, 24) - 0.6) * 0.8, 0, 0.6) * ridge
colours = blend((44, 37, 31), (146, 132, 115), ridge) * (1 + 0.09 * rough)[..., None]
colours = colours * (1 - moss)[..., None] + np.array((112, 122, 82)) * moss[..., None]
save_bark("bark.jpg", colours, ridge, 5.0)
