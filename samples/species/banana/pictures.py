#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Draws the pictures of banana.lsys: leaf.png (a leaf torn by the wind), young.png (a whole leaf) and stem.jpg.
Usage: samples/species/banana/pictures.py      Needs Pillow and NumPy (Debian: python3-pil, python3-numpy)."""
import os
import random
import sys

import numpy as np

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
from drawing import Card, blend, field, save_bark

os.chdir(os.path.dirname(os.path.abspath(__file__)))
draw = random.Random(14)
OUTLINE = [(0, 0.01), (0.03, 0.06), (0.1, 0.125), (0.3, 0.155), (0.6, 0.15), (0.82, 0.125), (0.94, 0.07), (1, 0.0)]


def half(t):
    return float(np.interp(t, [p for p, _ in OUTLINE], [w for _, w in OUTLINE]))


for name, torn in (("leaf.png", True), ("young.png", False)):
    card = Card(192, 512)
    rise = 0.035  # side veins rise towards the margin
    for side in (-1, 1):
        y = 0.0
        while y < 0.985:
            high = draw.uniform(0.03, 0.1) if torn else 0.02
            gap = draw.uniform(0.002, 0.012) if torn and draw.random() < 0.75 else 0.0
            top = min(y + high, 1)
            tone = draw.uniform(0.9, 1) if torn else 0.96
            steps = 8
            edge = [(side * half(min(y + (top - y) * k / steps + rise * half(y) / 0.155, 1)),
                     y + (top - y) * k / steps + rise * half(y) / 0.155) for k in range(steps + 1)]
            edge = [(x, v - gap * (k / steps)) for k, (x, v) in enumerate(edge)]
            card.fill_polygon([(0, y)] + edge + [(0, top)], (208 * tone, 222 * tone, 184 * tone))
            y = top
        for i in range(64):
            t = i / 64
            w = half(min(t + rise, 1)) * 0.97
            shade = 0.93 if i % 2 else 1.06
            card.line([(0, t), (side * w, t + rise * w / 0.155)], 0.0025, (206 * shade, 220 * shade, 180 * shade))
    card.line([(0, 0), (0, 0.985)], 0.016, (232, 236, 190))
    card.save(name, levels=20)

size = 512
streak = 0.5 + 0.3 * field(size, 3, 60, 15)
dry = np.clip((field(size, 14, 50, 16) - 0.2) * 1.5, 0, 0.85)
colours = blend((120, 138, 66), (168, 172, 96), streak)
colours = colours * (1 - dry)[..., None] + blend((74, 52, 36), (120, 90, 58), streak) * dry[..., None]
save_bark("stem.jpg", colours)
