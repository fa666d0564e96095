#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Draws soil.png, seen from above: dry soil is light, wet soil and patches rich in nutrients are dark. The map of
roots-in-soil.lsys reads it, and soil.obj shows it below the roots. Draws the same picture each time.
Usage: samples/roots-in-soil/soil.py      Needs Python only."""
import math
import os
import random
import struct
import zlib

SIZE = 128
# Wet patches: x and y of the centre, radius, as fractions of the picture's side; wetness.
PATCHES = [(0.76, 0.3, 0.17, 1), (0.2, 0.24, 0.12, 0.8), (0.3, 0.78, 0.2, 1), (0.83, 0.76, 0.1, 0.7)]

os.chdir(os.path.dirname(os.path.abspath(__file__)))
draw = random.Random(7)
grains = [[draw.gauss(0, 1) for _ in range(SIZE)] for _ in range(SIZE)]
rows = bytearray()
for row in range(SIZE):
    rows.append(0)  # no filter
    for column in range(SIZE):
        x, y = (column + 0.5) / SIZE, (row + 0.5) / SIZE
        wet = 0.16 + sum(w * math.exp(-((x - a) ** 2 + (y - b) ** 2) / (2 * (r / 1.6) ** 2)) for a, b, r, w in PATCHES)
        grey = 235 - 205 * min(wet, 1) + 5 * grains[row][column]
        rows.append(max(0, min(255, round(grey))))


def chunk(name, data):
    return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))


with open("soil.png", "wb") as file:
    file.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">2I5B", SIZE, SIZE, 8, 0, 0, 0, 0)) +
               chunk(b"IDAT", zlib.compress(bytes(rows), 9)) + chunk(b"IEND", b""))
