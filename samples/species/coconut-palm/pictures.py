#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Draws the pictures of coconut-palm.lsys: bark.jpg with its normals, the trunk with the rings of fallen fronds.
Usage: samples/species/coconut-palm/pictures.py      Needs Pillow and NumPy (Debian: python3-pil, python3-numpy)."""
import os
import sys

import numpy as np

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
from drawing import blend, field, save_bark

os.chdir(os.path.dirname(os.path.abspath(__file__)))
size = 512
y, x = np.mgrid[0:size, 0:size]
rings = (y + 5 * field(size, 40, 12, 51) + 10 * np.sin(2 * np.pi * x / size)) * 10 / size % 1
ring = np.clip(np.minimum(rings, 1 - rings) / 0.13, 0, 1)
crack = np.clip(np.abs(field(size, 2.2, 26, 52)) / 0.35, 0.25, 1)
rough = field(size, 1.5, 4, 53)
height = ring * (0.7 + 0.3 * crack)
lichen = np.clip((field(size, 26, 20, 54) - 0.9) * 1.5, 0, 0.5)
colours = blend((92, 80, 66), (166, 152, 132), height) * (1 + 0.07 * rough)[..., None]
colours = colours * (1 - lichen)[..., None] + np.array((196, 194, 180)) * lichen[..., None]
save_bark("bark.jpg", colours, height, 4.0)
