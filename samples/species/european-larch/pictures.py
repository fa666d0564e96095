#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Draws the pictures of european-larch.lsys: bark.jpg and its normals, spray.png (a branchlet with tufts of needles)
and twig.png (the same without needles).
Usage: samples/species/european-larch/pictures.py      Needs Pillow and NumPy (Debian: python3-pil, python3-numpy)."""
import os
import random
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
from drawing import Card, along, blend, field, save_bark, bark_plates

os.chdir(os.path.dirname(os.path.abspath(__file__)))
draw = random.Random(91)


def tufted(card, place, direction, length, bend, needles):
    """A thin twig with short shoots, each with a tuft of soft needles."""
    steps = max(3, round(length / 0.043))
    heading = direction
    for i in range(steps):
        heading += bend / steps
        ahead = along(place, heading, length / steps)
        card.line([place, ahead], 0.009 if needles else 0.014, (176, 140, 92))
        place = ahead
        if not needles:
            card.line([along(place, heading + 90, 0.012), along(place, heading - 90, 0.012)], 0.014, (122, 94, 66))
            continue
        tone = draw.uniform(0.8, 1)
        # The needles of a tuft spread forwards; single needles stand between the tufts.
        for k in range(32):
            shade = tone * draw.uniform(0.85, 1.15)
            aside = draw.triangular(8, 165, 50)
            foot = place if k < 26 else along(place, heading + 180, draw.uniform(0.008, 0.036))
            tip = along(foot, heading + draw.choice((-1, 1)) * aside, draw.uniform(0.034, 0.068) * (1 - aside / 420))
            card.line([foot, tip], 0.004, (206 * shade, 222 * shade, 178 * shade))


for name, needles in (("spray.png", True), ("twig.png", False)):
    card = Card(352, 512)
    for start, direction, length, bend in ((0.05, -48, 0.44, 36), (0.12, 46, 0.46, -36), (0.28, -42, 0.4, 30),
                                           (0.36, 40, 0.38, -30), (0.52, -36, 0.28, 24), (0.6, 34, 0.26, -24)):
        tufted(card, (0, start), direction, length, bend, needles)
    tufted(card, (0, 0), 0, 0.92, 4, needles)
    card.save(name, levels=16)

edge, number = bark_plates(512, 120, 2.4, 92)
height = edge**0.7 * (0.7 + 0.3 * number)
plates = blend((138, 112, 96), (112, 86, 72), number) * (1 + 0.09 * field(512, 1.5, 3, 93))[..., None]
part = (edge**0.6)[..., None]
save_bark("bark.jpg", blend((70, 42, 34), (0, 0, 0), height * 0) * (1 - part) + plates * part, height, 4.0)
