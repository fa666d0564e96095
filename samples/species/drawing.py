# SPDX-License-Identifier: MIT
"""Drawing with Pillow and NumPy for the pictures of the species: leaves with holes around them, and bark that
repeats without seams. Used by the scripts NAME/pictures.py, which draw the same pictures each time."""
import math

import numpy as np
from PIL import Image, ImageDraw

FINE = 4  # drawn pixels per pixel of the written picture, along each side


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


def toothed(outline, teeth, depth):
    """An outline of a leaf, [(part of the length, half width / length), ...], with teeth that point to the tip."""
    places = [outline[0]]
    for i in range(teeth):
        for part, out in ((0.2, -depth), (0.85, depth)):
            t = (i + part) / teeth
            places.append((t + 0.3 * max(out, 0), float(np.interp(t, *zip(*outline))) + out * math.sin(math.pi * t)))
    return [(t, max(w, 0.003)) for t, w in places] + [(1, 0)]


def flower(card, place, radius, turn, outline, colours, stamens, squash=1.0, slant=0.0, random=None):
    """A flower of five petals seen from the front, or aslant: narrower by `squash` along the direction `slant`.
    `colours`: of a petal at its base, in its middle and at its end, and of the heart; `stamens`: their number,
    length / radius, and the colours of filament and anther."""
    def at(direction, distance, aside=0.0):
        x, y = along((0, 0), direction, distance * radius, aside * radius)
        s, c = math.sin(math.radians(slant)), math.cos(math.radians(slant))
        ahead, across = (x * s + y * c) * squash, x * c - y * s
        return (place[0] + ahead * s + across * c, place[1] + ahead * c - across * s)

    base, middle, end, heart = colours
    for k in (0, 2, 4, 1, 3):
        direction = turn + 72 * k + (random.uniform(-4, 4) if random else 0)
        tone = random.uniform(0.93, 1) if random else 1
        edge = [at(direction, t, w) for t, w in outline] + [at(direction, t, -w) for t, w in outline[::-1]]
        card.fill_polygon(edge, shaded(end, tone))
        steps = 14  # bands of colour from the base to the end
        for side, light in ((1, 0.965), (-1, 1.0)):
            for i in range(steps):
                low, high = i / steps, (i + 1) / steps
                mean = (low + high) / 2
                pair = (base, middle) if mean < 0.45 else (middle, end)
                part = mean / 0.45 if mean < 0.45 else (mean - 0.45) / 0.55
                colour = [(a + (b - a) * part) * tone * light for a, b in zip(*pair)]
                wide = [float(np.interp(t, *zip(*outline))) * side for t in (low, high)]
                card.fill_polygon([at(direction, low), at(direction, low, wide[0]), at(direction, high, wide[1]),
                           at(direction, high)], colour)
        for bend in (-0.28, -0.14, 0, 0.14, 0.28):
            card.line([at(direction, 0.15, bend * 0.3), at(direction, 0.85, bend)], 0.008 * radius,
                      shaded(end, 0.96 * tone))
        card.line(edge, 0.018 * radius, shaded(end, 0.86 * tone))
    card.fill_polygon([at(24 * i, 0.13) for i in range(15)], heart)
    count, reach, filament, anther = stamens
    for i in range(count):
        direction = turn + 360 * i / count + (random.uniform(-6, 6) if random else 0)
        length = reach * (random.uniform(0.55, 1) if random else 1)
        card.line([at(direction, 0.07), at(direction, length)], 0.02 * radius, filament)
        card.fill_polygon([at(direction + 9 * math.sin(0.9 * j), length + 0.05 * math.cos(0.9 * j)) for j in range(7)], anther)


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
