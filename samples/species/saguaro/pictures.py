#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Draws the pictures of saguaro.lsys: skin.jpg with its normals, a stem with ribs and areoles.
Usage: samples/species/saguaro/pictures.py      Needs Pillow and NumPy (Debian: python3-pil, python3-numpy)."""
import math
import os
import sys

import numpy as np

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
from drawing import blend, field, save_bark

os.chdir(os.path.dirname(os.path.abspath(__file__)))
size, ribs = 512, 16
y, x = np.mgrid[0:size, 0:size]
wave = x + 1.6 * field(size, 4, 60, 81)
part = wave * ribs / size % 1
rib = np.clip(1 - np.abs(part - 0.5) * 2, 0, 1)  # 1 on the ridge
height = np.sin(rib * math.pi / 2) ** 0.8
areole = np.hypot((part - 0.5) * size / ribs, (y + (np.floor(wave * ribs / size) % 2) * 11) % 22 - 11)
spot = np.clip((5.2 - areole) / 2, 0, 1)
spines = np.clip((np.abs(part - 0.5) < 0.13) * (field(size, 1.2, 2.2, 82) > 0.7), 0, 1)
colours = blend((44, 66, 44), (118, 142, 96), height) * (1 + 0.05 * field(size, 20, 40, 83))[..., None]
colours = colours * (1 - 0.75 * spot)[..., None] + np.array((198, 184, 158)) * 0.75 * spot[..., None]
colours = colours * (1 - 0.4 * spines)[..., None] + np.array((186, 174, 150)) * 0.4 * spines[..., None]
save_bark("skin.jpg", colours, height, 9.0)
