#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Draws the pictures of stone-field.toml: stones.png and stones-normals.png, round stones in moss, which repeat
without seams, and blade.png, a leaf with holes.
Usage: samples/scenes/stone-field/stone-field.py      Needs Python alone; draws the same pictures each time."""
import hashlib
import os
import struct
import zlib

SIZE = 128
CELLS = 8  # stones along a side


def random_unit(i, j, salt):
    """A number in [0, 1)."""
    key = struct.pack("<iii", i, j, salt)
    return int.from_bytes(hashlib.blake2b(key, digest_size=4).digest(), "little") / 2**32


def stone_at(x, y):
    """Height and number of the stone at a place, in pixels; height 0 is moss."""
    u, v = x * CELLS / SIZE, y * CELLS / SIZE
    best = (0.0, 0)
    for j in range(int(v) - 1, int(v) + 2):
        for i in range(int(u) - 1, int(u) + 2):
            cell = (i % CELLS, j % CELLS)
            dx = u - (i + 0.2 + 0.6 * random_unit(*cell, 1))
            dy = v - (j + 0.2 + 0.6 * random_unit(*cell, 2))
            radius = 0.25 + 0.35 * random_unit(*cell, 3)
            square = 1 - (dx * dx + dy * dy) / (radius * radius)
            if square > 0:
                best = max(best, (radius * square**0.5, (j % CELLS) * CELLS + i % CELLS))
    return best


def grain(x, y, salt):
    """A random number in [0, 1) for a pixel."""
    return random_unit(x % SIZE * SIZE + y % SIZE, 0, salt)


def colour_at(x, y):
    height, stone = HEIGHTS[y % SIZE][x % SIZE]
    if height == 0:
        shade = 0.75 + 0.5 * grain(x, y, 7)
        return tuple(round(shade * c) for c in (58, 74, 30))
    grey = 78 + 56 * random_unit(stone, 0, 5) + 18 * (grain(x, y, 8) - 0.5)
    warm = 14 * random_unit(stone, 1, 6)
    shade = 0.72 + 0.5 * height
    return tuple(min(255, round(shade * c)) for c in (grey + warm, grey + 0.4 * warm, grey - warm))


def normal_at(x, y):
    def slope(dx, dy):
        ahead = HEIGHTS[(y + dy) % SIZE][(x + dx) % SIZE][0]
        behind = HEIGHTS[(y - dy) % SIZE][(x - dx) % SIZE][0]
        return 0.5 * (ahead - behind) * SIZE / CELLS

    right, up = slope(1, 0), slope(0, -1)
    length = (right * right + up * up + 1) ** 0.5
    return tuple(round(127.5 + 127.5 * c / length) for c in (-right, -up, 1.0))


def blade(x, y):
    """Colour and opacity of a pixel of a leaf, which is 64 pixels high and has its base at the bottom."""
    along = 1 - (y + 0.5) / 64
    aside = abs((x + 0.5) / 64 - 0.5)
    half = 1.7 * along * (1 - along) * (1.15 - 0.6 * along)
    half -= 0.035 * (16 * along % 1)
    vein = aside < 0.018 or abs(16 * (along - 0.5 * aside) % 1 - 0.5) > 0.42
    shade = (1.25 if vein else 1.0) * (0.8 + 0.5 * along)
    colour = tuple(min(255, round(shade * c)) for c in (96, 132, 44))
    return colour + (255 if aside < half else 0,)


def chunk(kind, data):
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))


def write(name, size, texel):
    channels = len(texel(0, 0))
    rows = b"".join(
        b"\0" + b"".join(bytes(texel(x, y)) for x in range(size)) for y in range(size)
    )
    path = os.path.join(os.path.dirname(os.path.abspath(__file__)), name)
    with open(path, "wb") as picture:
        picture.write(b"\x89PNG\r\n\x1a\n")
        picture.write(chunk(b"IHDR", struct.pack(">IIBBBBB", size, size, 8, 4 * channels - 10, 0, 0, 0)))
        picture.write(chunk(b"IDAT", zlib.compress(rows, 9)))
        picture.write(chunk(b"IEND", b""))


HEIGHTS = [[stone_at(x, y) for x in range(SIZE)] for y in range(SIZE)]
write("stones.png", SIZE, colour_at)
write("stones-normals.png", SIZE, normal_at)
write("blade.png", 64, blade)
