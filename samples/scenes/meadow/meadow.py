#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Draws meadow.png, a map of densities: patches of three sizes, and a path without plants.
Usage: samples/scenes/meadow/meadow.py      Needs Python alone; draws the same picture each time."""
import os
import struct
import zlib

SIZE = 128


def noise(x, y, cell, salt):
    """Smooth values in [0, 1] between the corners of a grid of `cell` pixels."""

    def corner(i, j):
        return zlib.crc32(struct.pack("<iii", i, j, salt)) / 0xFFFFFFFF

    i, j = x // cell, y // cell
    u, v = x % cell / cell, y % cell / cell
    u, v = u * u * (3 - 2 * u), v * v * (3 - 2 * v)
    top = corner(i, j) * (1 - u) + corner(i + 1, j) * u
    bottom = corner(i, j + 1) * (1 - u) + corner(i + 1, j + 1) * u
    return top * (1 - v) + bottom * v


def density(x, y):
    patches = 0.55 * noise(x, y, 32, 1) + 0.3 * noise(x, y, 12, 2) + 0.15 * noise(x, y, 5, 3)
    middle = 40 + 0.004 * (y - 50) ** 2 + 6 * noise(0, y, 16, 4)
    path = min(1.0, max(0.0, (abs(x - middle) - 3) / 4))
    return path * min(1.0, max(0.0, 2.2 * patches - 0.5))


def chunk(kind, data):
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))


rows = b"".join(
    b"\0" + bytes(round(255 * density(x, y)) for x in range(SIZE)) for y in range(SIZE)
)
with open(os.path.join(os.path.dirname(os.path.abspath(__file__)), "meadow.png"), "wb") as picture:
    picture.write(b"\x89PNG\r\n\x1a\n")
    picture.write(chunk(b"IHDR", struct.pack(">IIBBBBB", SIZE, SIZE, 8, 0, 0, 0, 0)))
    picture.write(chunk(b"IDAT", zlib.compress(rows, 9)))
    picture.write(chunk(b"IEND", b""))
