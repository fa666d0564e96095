# SPDX-License-Identifier: MIT
"""Drawing with Pillow and NumPy for the pictures of the species: leaves with holes around them, and bark that
repeats without seams. Used by the scripts NAME/pictures.py, which draw the same pictures each time."""
import math

import numpy as np
from PIL import Image, ImageDraw

FINE = 4  # a picture is drawn with this many pixels for each of its own, along both sides


class Card:
    """A picture `wide` by `high` pixels with a transparent ground. Places are (x, y) with x from -wide/high/2 to
    wide/high/2 and y from 0 at the lower edge to 1."""

    def __init__(self, wide, high):
        self.wide, self.high = wide, high
        self.image = Image.new("RGBA", (wide * FINE, high * FINE), (0, 0, 0, 0))
        self.pen = ImageDraw.Draw(self.image)

    def pixel(self, place):
        return ((place[0] * self.high + self.wide / 2) * FINE, (1 - place[1]) * self.high * FINE)

    def fill_polygon(self, places, colour):
        self.pen.polygon([self.pixel(place) for place in places], fill=opaque(colour))

    def line(self, places, width, colour):
        """A line through places; `width` in the units of the places."""
        pixels = [self.pixel(place) for place in places]
        self.pen.line(pixels, fill=opaque(colour), width=max(1, round(width * self.high * FINE)), joint="curve")

    def save(self, path, levels=32):
        """Writes the picture; transparent texels get the mean colour, so that edges have no dark rim."""
        fine = np.asarray(self.image, dtype=np.float64) / 255
        fine = fine.reshape(self.high, FINE, self.wide, FINE, 4)
        alpha = fine[..., 3:]
        cover = alpha.mean(axis=(1, 3))
        total = (fine[..., :3] * alpha).sum(axis=(1, 3))
        mean = total.sum(axis=(0, 1)) / max(alpha.sum(), 1)
        weight = alpha.sum(axis=(1, 3))
        colour = np.where(weight > 0, total / np.maximum(weight, 1e-9), mean)
        step = 255 / (levels - 1)
        colour = np.round(colour * 255 / step) * step
        cover = np.round(cover * 15) * 17
        pixels = np.concatenate([colour, cover], axis=2)
        Image.fromarray(np.clip(np.round(pixels), 0, 255).astype(np.uint8), "RGBA").save(path, optimize=True)


def opaque(colour):
    return tuple(int(min(max(part, 0), 255)) for part in colour) + (255,)


def shaded(colour, factor):
    return tuple(part * factor for part in colour)


def along(place, direction, distance, aside=0.0):
    """The place `distance` ahead and `aside` to the right of a place; direction in degrees from up, clockwise."""
    s, c = math.sin(math.radians(direction)), math.cos(math.radians(direction))
    return (place[0] + distance * s + aside * c, place[1] + distance * c - aside * s)


def leaf(card, place, direction, length, outline, colour, vein, veins=6, vein_angle=40, stalk=0.0):
    """A leaf at the end of its stalk. `outline`: half widths, [(part of the length, half width / length), ...]."""
    base = along(place, direction, stalk * length)
    if stalk > 0:
        card.line([place, base], 0.03 * length, vein)
    right = [along(base, direction, t * length, w * length) for t, w in outline]
    left = [along(base, direction, t * length, -w * length) for t, w in outline]
    card.fill_polygon(right + left[::-1], colour)
    # The right half lies a little in the shade, so that the leaf looks folded along its midrib; a dark
    # edge sets it off from the leaves below.
    card.fill_polygon(right + [along(base, direction, length), base], shaded(colour, 0.9))
    card.line(right + left[::-1] + right[:1], 0.016 * length, shaded(colour, 0.66))
    card.line([base, along(base, direction, length * 0.97)], 0.022 * length, vein)
    for i in range(veins):
        t = 0.06 + 0.8 * i / veins
        reach = max(min(np.interp([t + 0.1, t + 0.3], [p for p, _ in outline], [w for _, w in outline])), 0.02)
        for side in (-1, 1):
            start = along(base, direction, t * length)
            run = 0.92 * reach * length / math.sin(math.radians(vein_angle))
            card.line([start, along(start, direction + side * vein_angle, run)], 0.009 * length, vein)


def field(size, sx, sy, seed):
    """Random numbers with mean 0 and deviation 1 over a square that repeats, smooth over sx and sy pixels."""
    white = np.random.default_rng(seed).standard_normal((size, size))
    fx = np.fft.fftfreq(size)[None, :]
    fy = np.fft.fftfreq(size)[:, None]
    smooth = np.fft.ifft2(np.fft.fft2(white) * np.exp(-2 * math.pi**2 * ((fx * sx) ** 2 + (fy * sy) ** 2))).real
    return (smooth - smooth.mean()) / smooth.std()


def bark_plates(size, count, tall, seed):
    """Plates of bark: for each pixel the distance to the edge of its plate, 0 to 1, and a random number of that plate.
    `tall` is the height of a plate divided by its width."""
    random = np.random.default_rng(seed)
    points = random.random((count, 2)) * size
    y, x = np.mgrid[0:size, 0:size]
    x = x + 3 * field(size, 5, 5, seed + 1)
    y = y + 3 * field(size, 5, 5, seed + 2)
    first = np.full((size, size), 1e9)
    second = np.full((size, size), 1e9)
    number = np.zeros((size, size), dtype=int)
    for i, (px, py) in enumerate(points):
        dx = np.abs(x - px) % size
        dy = np.abs(y - py) % size
        away = np.hypot(np.minimum(dx, size - dx), np.minimum(dy, size - dy) / tall)
        nearer = away < first
        second = np.where(nearer, first, np.minimum(second, away))
        number = np.where(nearer, i, number)
        first = np.where(nearer, away, first)
    return np.clip((second - first) / (0.35 * size / math.sqrt(count * tall)), 0, 1), random.random(count)[number]


def blend(low, high, t):
    """Colours between two, by a field of numbers from 0 to 1."""
    t = np.clip(t, 0, 1)[..., None]
    return np.array(low) * (1 - t) + np.array(high) * t


def save_bark(path, colours, height=None, depth=6.0):
    """Writes the colours, 0 to 255, as JPEG, and beside it the normals of a relief `height`, 0 to 1."""
    Image.fromarray(np.clip(colours, 0, 255).astype(np.uint8), "RGB").save(path, quality=82)
    if height is not None:
        gx = (np.roll(height, -1, 1) - np.roll(height, 1, 1)) * depth
        gy = (np.roll(height, -1, 0) - np.roll(height, 1, 0)) * depth
        normal = np.stack([-gx, gy, np.ones_like(gx)], axis=2)
        normal /= np.linalg.norm(normal, axis=2, keepdims=True)
        name = path.replace(".jpg", "-normals.jpg")
        Image.fromarray(np.clip(normal * 127.5 + 127.5, 0, 255).astype(np.uint8), "RGB").save(name, quality=80)
