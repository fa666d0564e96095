# SPDX-License-Identifier: MIT
"""Pictures of plants in notebooks, drawn by numpy."""

import struct
import zlib

import numpy as np

# Unit vector to the light.
_LIGHT = np.array([0.35, 0.8, 0.5]) / np.linalg.norm([0.35, 0.8, 0.5])
_MAX_SAMPLES = 4_000_000  # about the max number of points that draw() draws


def colours_of(mesh):
    """Linear material colours of the triangles, as an array of (triangles, 3) float32."""
    colours = np.zeros((len(mesh.indices), 3), np.float32)
    for material, first, count in mesh.parts:
        colours[first // 3:(first + count) // 3] = mesh.materials[material]["colour"][:3]
    return colours


def draw(mesh, width=320, height=400):
    """The mesh seen from +Z, as an array of (height, width, 3) bytes in sRGB."""
    picture = np.full((height, width, 3), 255, np.uint8)
    if len(mesh.indices) == 0:
        return picture
    positions = np.asarray(mesh.positions, np.float64)
    low, high = positions.min(axis=0), positions.max(axis=0)
    scale = min((width - 16) / max(high[0] - low[0], 1e-9),
                (height - 16) / max(high[1] - low[1], 1e-9))
    middle = (low + high) / 2
    corners = positions[mesh.indices]  # (triangles, 3, 3)
    corners[..., 0] = (corners[..., 0] - middle[0]) * scale + width / 2
    corners[..., 1] = height / 2 - (corners[..., 1] - middle[1]) * scale
    edges = corners[:, 1:, :2] - corners[:, :1, :2]
    area = np.abs(edges[:, 0, 0] * edges[:, 1, 1] - edges[:, 0, 1] * edges[:, 1, 0]) / 2
    # Triangles are drawn as points, about four for each pixel that they cover.
    counts = np.ceil(4 * area).astype(np.int64) + 1
    if counts.sum() > _MAX_SAMPLES:
        counts = np.maximum(counts * _MAX_SAMPLES // counts.sum(), 1)
    triangle = np.repeat(np.arange(len(corners)), counts)
    number = np.arange(len(triangle)) - np.repeat(np.cumsum(counts) - counts, counts)
    # A low-discrepancy sequence, folded into the triangle.
    u = (0.5 + number * 0.7548776662466927) % 1.0
    v = (0.5 + number * 0.5698402909980532) % 1.0
    folded = u + v > 1
    u[folded], v[folded] = 1 - u[folded], 1 - v[folded]
    points = (corners[triangle, 0] * (1 - u - v)[:, None] + corners[triangle, 1] * u[:, None] +
              corners[triangle, 2] * v[:, None])
    x = np.clip(points[:, 0].astype(np.int64), 0, width - 1)
    y = np.clip(points[:, 1].astype(np.int64), 0, height - 1)
    pixel = y * width + x
    # The nearest point of each pixel is the last one that is written.
    order = np.lexsort((points[:, 2], pixel))
    last = np.append(np.diff(pixel[order]) != 0, True)
    shown = order[last]
    normals = np.asarray(mesh.normals)[mesh.indices].mean(axis=1)
    normals[normals[:, 2] < 0] *= -1  # leaves have two sides
    light = 0.35 + 0.65 * np.clip(normals @ _LIGHT, 0, 1)
    linear = np.clip(colours_of(mesh) * light[:, None], 0, 1)[triangle[shown]]
    srgb = np.where(linear <= 0.0031308, 12.92 * linear,
                    1.055 * np.power(linear, 1 / 2.4, where=linear > 0, out=np.zeros_like(linear))
                    - 0.055)
    picture.reshape(-1, 3)[pixel[shown]] = np.round(255 * srgb).astype(np.uint8)
    return picture


def png(picture):
    """The bytes of a PNG of an array of (height, width, 3) bytes."""
    height, width, _ = picture.shape

    def chunk(kind, data):
        return (struct.pack(">I", len(data)) + kind + data +
                struct.pack(">I", zlib.crc32(kind + data)))

    rows = np.zeros((height, 1 + 3 * width), np.uint8)  # each row begins with PNG filter 0, none
    rows[:, 1:] = picture.reshape(height, -1)
    header = struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) +
            chunk(b"IDAT", zlib.compress(rows.tobytes(), 9)) + chunk(b"IEND", b""))
