#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Draws blade.jpg, the surface of a leaf of meadow-grasses.lsys, and the spikelets of its grasses: spikelet.png of
false oat-grass with its awn, cluster.png of cock's-foot.
Usage: samples/species/meadow-grasses/pictures.py   Needs Pillow and NumPy (Debian: python3-pil, python3-numpy)."""
import os
import sys

import numpy as np

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
from drawing import Card, along, field, leaf, save_bark

os.chdir(os.path.dirname(os.path.abspath(__file__)))

# A blade: parallel veins, a pale midrib, edges a little darker; the blade is as wide as the picture.
across = np.abs(np.linspace(-1, 1, 128))[None, :]
veins = np.cos(across * 14 * np.pi) * 9 + 8 * field(128, 0.6, 30, 5)
rib = np.exp(-((across / 0.09) ** 2))
tone = 205 + veins - 26 * across**3 + 34 * rib
save_bark("blade.jpg", np.stack([tone + 4 * rib, tone + 12, tone * 0.86 + 14 * rib], axis=2))

GLUME = [(0, 0.03), (0.12, 0.1), (0.35, 0.13), (0.6, 0.1), (0.85, 0.04), (1, 0)]
PALE, KEEL = (236, 234, 206), (206, 216, 160)

# Two glumes and two florets; the lower floret has a bent awn.
card = Card(64, 128)
card.line([(0, 0), (0, 0.08)], 0.03, KEEL)
for angle, length in ((-17, 0.5), (17, 0.58), (-7, 0.64), (7, 0.66)):
    leaf(card, (0, 0.04), angle, length, GLUME, PALE, KEEL, veins=0)
card.line([(0.02, 0.35), (0.05, 0.66), (0.16, 0.99)], 0.022, (150, 124, 84))
card.save("spikelet.png", levels=24)

# A flat fan of florets behind two keeled glumes.
card = Card(64, 128)
card.line([(0, 0), (0, 0.1)], 0.04, KEEL)
for row, (angle, length) in enumerate(((-4, 0.58), (6, 0.62), (-12, 0.56), (14, 0.56), (-18, 0.48), (20, 0.46))):
    leaf(card, along((0, 0), 0, 0.36 - 0.06 * row), angle, length, GLUME, PALE, KEEL, veins=0)
card.save("cluster.png", levels=24)
