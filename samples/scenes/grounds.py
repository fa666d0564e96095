#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Draws the pictures of the ground of the scenes of species, each seen from above and repeated without seams:
spruce-wood/needles.png, beech-wood/leaves.png, birch-heath/heath.png, park/lawn.png, meadow/turf.png; and the map
sensing-wood/wood.png.
Usage: samples/scenes/grounds.py      Needs Pillow and NumPy (Debian: python3-pil, python3-numpy)."""
import math
import os
import random
import sys

import numpy as np
from PIL import Image, ImageDraw

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "species"))
from drawing import blend, field

os.chdir(os.path.dirname(os.path.abspath(__file__)))
SIZE = 256
FINE = 2  # drawn pixels per pixel of the picture, along each side


def soil(low, high, seed):
    """Colours between two, in patches of several sizes."""
    patches = 0.5 + 0.22 * field(SIZE * FINE, 46, 46, seed) + 0.14 * field(SIZE * FINE, 9, 9, seed + 1)
    return Image.fromarray(np.clip(blend(low, high, patches), 0, 255).astype(np.uint8), "RGB")


def scatter(image, seed, count, colours, shape):
    """Draws `count` shapes at random places and angles; shapes that cross an edge go on at the other one. `shape`
    returns the corners of one, in pixels of the picture."""
    draw = random.Random(seed)
    pen = ImageDraw.Draw(image)
    side = SIZE * FINE
    for _ in range(count):
        x, y, angle = draw.uniform(0, side), draw.uniform(0, side), draw.uniform(0, 2 * math.pi)
        tone = draw.uniform(0.72, 1.12)
        colour = tuple(min(255, round(part * tone)) for part in draw.choice(colours))
        c, s = FINE * math.cos(angle), FINE * math.sin(angle)
        corners = [(u * c - v * s, u * s + v * c) for u, v in shape(draw)]
        for dx in (-side, 0, side):
            for dy in (-side, 0, side):
                pen.polygon([(x + dx + u, y + dy + v) for u, v in corners], fill=colour)


def strip(length, width):
    return lambda draw: [(-length * (s := draw.uniform(0.5, 0.7)), -width), (length * s, -width), (length * s, width),
                         (-length * s, width)]


def leaf(length):
    def corners(draw):
        s = length * draw.uniform(0.7, 1.1)
        return [(-s / 2, 0), (-s / 4, s / 4), (s / 6, s / 4.5), (s / 2, 0), (s / 6, -s / 4.5), (-s / 4, -s / 4)]
    return corners


def save(image, path):
    small = image.resize((SIZE, SIZE), Image.BOX)
    small.quantize(16, dither=Image.NONE).convert("RGB").save(path, optimize=True)


ground = soil((58, 44, 32), (104, 78, 52), 1)
scatter(ground, 2, 1500, [(70, 88, 40), (84, 100, 46)], leaf(6))                             # moss
scatter(ground, 3, 2600, [(112, 78, 48), (92, 62, 40), (134, 98, 62)], strip(6, 0.5))        # needles
scatter(ground, 4, 50, [(88, 72, 58)], strip(26, 0.8))                                       # twigs
save(ground, "spruce-wood/needles.png")

ground = soil((78, 54, 36), (110, 78, 50), 11)
scatter(ground, 12, 1500, [(140, 92, 54), (116, 74, 44), (164, 112, 66), (96, 66, 44), (150, 108, 76)], leaf(15))
scatter(ground, 13, 40, [(96, 84, 72)], strip(30, 0.9))
save(ground, "beech-wood/leaves.png")

ground = soil((40, 32, 28), (64, 56, 38), 21)
scatter(ground, 22, 1500, [(70, 48, 50), (84, 52, 60), (58, 54, 38)], leaf(9))              # heather
scatter(ground, 23, 2400, [(108, 94, 58), (86, 80, 46), (64, 72, 38)], strip(11, 0.5))   # grass
save(ground, "birch-heath/heath.png")

ground = soil((56, 76, 34), (76, 96, 44), 31)
scatter(ground, 32, 4200, [(66, 90, 38), (82, 106, 48), (54, 76, 34), (98, 114, 58)], strip(7, 0.5))
save(ground, "park/lawn.png")

ground = soil((42, 52, 24), (58, 70, 32), 41)
scatter(ground, 42, 3000, [(58, 76, 32), (74, 88, 42), (46, 62, 26), (104, 98, 60)], strip(12, 0.6))
save(ground, "meadow/turf.png")

# Where trees stand in sensing-wood: a wood with an edge, a clearing, and a few lone trees on a meadow. 1 pixel = 2 m.
SIDE = 215
lone = random.Random(5)
lone = {(lone.randrange(8, SIDE - 8), lone.randrange(6, 36)) for _ in range(9)}


def has_trees(x, z):
    is_clearing = ((x - 127) / 15)**2 + ((z - 122) / 14)**2 < 1
    return (x, z) in lone or (z > 48 + 4 * math.sin(x / 21) and not is_clearing)


wood = Image.new("L", (SIDE, SIDE))
wood.putdata([255 if has_trees(x, z) else 0 for z in range(SIDE) for x in range(SIDE)])
wood.save("sensing-wood/wood.png", optimize=True)
