#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Writes wall.obj, a wall with a window, which climber.lsys senses and draws. The mesh is closed.
Usage: samples/climber/wall.py"""
import os

ACROSS = [-2, -0.55, 0.55, 2]  # m, edges of the wall and of the window from left to right
UP = [0, 1.1, 2.3, 3]          # m, from the ground
BACK, FRONT = -0.3, 0          # m, the wall faces +z

os.chdir(os.path.dirname(os.path.abspath(__file__)))
cells = [(i, j) for i in range(3) for j in range(3) if (i, j) != (1, 1)]
number = {}
for z in range(2):
    for y in range(4):
        for x in range(4):
            number[x, y, z] = len(number) + 1
faces = []
for i, j in cells:
    faces.append([(i, j, 1), (i + 1, j, 1), (i + 1, j + 1, 1), (i, j + 1, 1)])
    faces.append([(i, j, 0), (i, j + 1, 0), (i + 1, j + 1, 0), (i + 1, j, 0)])
    for side, (x, y), (u, v) in [((-1, 0), (i, j + 1), (i, j)), ((1, 0), (i + 1, j), (i + 1, j + 1)),
                                 ((0, -1), (i, j), (i + 1, j)), ((0, 1), (i + 1, j + 1), (i, j + 1))]:
        if (i + side[0], j + side[1]) not in cells:
            faces.append([(x, y, 0), (u, v, 0), (u, v, 1), (x, y, 1)])
with open("wall.obj", "w", encoding="ascii", newline="\n") as file:
    file.write("# A wall with a window, m. Written by wall.py.\n")
    for x, y, z in number:
        file.write(f"v {ACROSS[x]} {UP[y]} {(BACK, FRONT)[z]}\n")
    for face in faces:
        file.write("f " + " ".join(str(number[corner]) for corner in face) + "\n")
