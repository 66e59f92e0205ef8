#!/usr/bin/env python3
"""Writes the courtyard's camera paths: campaths/*.pth.

Usage: paths.py FOLDER

Each path is a closed loop through a few views (where the camera stands, what it looks at), slow
enough that aliasing, shimmer and blur can be watched: a closed Catmull-Rom curve for
both, sampled at a fixed period. Needs only Python 3. Units: metres and seconds; +Y is up.
"""
import math
import pathlib
import sys

PERIOD_S = 1.0 / 10.0  # between keys; positions and orientations are interpolated in between

# name: (what it shows, loop in seconds, [(position, target), ...])
PATHS = {
    "ambient": ("in through the gate, around the fountain, through a gallery and back", 60, [
        ((1.2, 1.7, 15.6), (0.4, 4.0, -2.0)),
        ((0.4, 1.7, 12.6), (0.1, 3.7, -2.0)),
        ((0.0, 1.7, 9.6), (0.3, 3.3, -2.6)),
        ((-1.5, 1.75, 7.2), (1.2, 3.1, -3.5)),
        ((-4.4, 1.95, 5.4), (2.2, 2.5, -1.6)),
        ((-4.0, 2.2, 4.4), (3.2, 2.3, -4.4)),
        ((-0.2, 2.3, 5.4), (1.6, 2.7, -4.8)),
        ((3.6, 2.1, 5.6), (1.6, 2.9, -4.6)),
        ((5.0, 1.9, 4.0), (4.6, 2.7, -5.2)),
        ((7.2, 1.8, 3.4), (8.6, 2.4, -6.0)),
        ((9.8, 1.7, 3.9), (11.0, 2.2, -7.0)),
        ((11.7, 1.7, 2.2), (11.2, 2.1, -8.0)),
        ((11.9, 1.7, -0.6), (6.4, 2.2, -7.0)),
        ((10.5, 1.7, -0.3), (0.4, 2.2, -3.6)),
        ((8.0, 1.8, 0.8), (-3.0, 2.7, -3.6)),
        ((5.4, 1.9, 3.9), (-3.4, 3.1, -4.0)),
        ((2.8, 1.9, 7.4), (-1.0, 3.4, -2.8)),
        ((0.5, 1.75, 9.2), (-0.4, 3.6, -2.4)),
        ((0.1, 1.7, 12.2), (-0.2, 3.8, -2.0)),
        ((0.9, 1.7, 14.8), (0.1, 4.0, -2.0)),
    ]),
    "aa": ("antialiasing: roof line, window bars, balusters and spear tips against the sky", 24, [
        ((0.3, 1.7, 14.9), (1.0, 4.5, -2.0)),
        ((0.8, 1.8, 14.5), (1.3, 4.7, -2.0)),
        ((1.0, 2.0, 14.1), (1.2, 5.0, -2.0)),
        ((0.5, 1.9, 14.2), (0.9, 4.9, -2.0)),
    ]),
    "af": ("anisotropic filtering: a gallery's paving, walls and ceiling, low and long", 24, [
        ((11.6, 0.62, 8.6), (11.4, 1.03, -8.0)),
        ((11.4, 0.66, 8.2), (11.7, 1.0, -8.0)),
        ((11.2, 0.74, 7.9), (11.9, 0.98, -8.0)),
        ((11.3, 0.67, 8.3), (11.5, 1.02, -8.0)),
    ]),
    "aaa": ("adaptive antialiasing: the fence seen obliquely, fountain and sky behind", 24, [
        ((-5.5, 1.6, 11.2), (-1.6, 2.15, 7.4)),
        ((-5.1, 1.66, 11.4), (-1.3, 2.25, 7.2)),
        ((-4.6, 1.75, 11.6), (-1.3, 2.35, 7.0)),
        ((-5.1, 1.66, 11.4), (-1.8, 2.2, 7.3)),
    ]),
    "miplod": ("mip level of detail: tower brick, roof tiles and setts, in a slow dolly", 24, [
        ((-2.6, 1.7, 9.6), (0.9, 3.9, -5.0)),
        ((-1.6, 1.8, 8.6), (1.1, 4.0, -5.0)),
        ((-0.4, 1.9, 8.0), (1.0, 4.0, -5.0)),
        ((-1.5, 1.8, 8.7), (0.8, 3.9, -5.0)),
    ]),
    "water": ("the fountain's basin: columns and sky mirrored in the water", 24, [
        ((0.9, 1.46, 2.35), (3.6, 1.0, -3.5)),
        ((1.2, 1.53, 2.25), (3.3, 1.0, -3.5)),
        ((1.5, 1.6, 2.05), (3.2, 1.0, -3.5)),
        ((1.2, 1.53, 2.3), (3.4, 0.97, -3.5)),
    ]),
}


def subtract(a, b):
    return [x - y for x, y in zip(a, b)]


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def normalised(a):
    length = math.sqrt(sum(x * x for x in a))
    return [x / length for x in a]


def closed_curve(points, phase):
    """Point at phase 0..1 of the uniform closed Catmull-Rom curve through the points."""
    count = len(points)
    at = phase * count
    i = int(math.floor(at))
    t = at - i
    p = [points[(i + k) % count] for k in (-1, 0, 1, 2)]
    weights = (-0.5 * t + t * t - 0.5 * t**3, 1.0 - 2.5 * t * t + 1.5 * t**3,
               0.5 * t + 2.0 * t * t - 1.5 * t**3, -0.5 * t * t + 0.5 * t**3)
    return [sum(w * q[axis] for w, q in zip(weights, p)) for axis in range(3)]


def looking(position, target):
    """Quaternion (x, y, z, w) of a camera that looks along -Z with +Y up."""
    back = normalised(subtract(position, target))
    right = normalised(cross([0.0, 1.0, 0.0], back))
    up = cross(back, right)
    m = [[right[r], up[r], back[r]] for r in range(3)]  # columns are the camera's axes
    w = math.sqrt(max(0.0, 1.0 + m[0][0] + m[1][1] + m[2][2])) / 2.0
    x = math.copysign(
        math.sqrt(max(0.0, 1.0 + m[0][0] - m[1][1] - m[2][2])) / 2.0, m[2][1] - m[1][2])
    y = math.copysign(
        math.sqrt(max(0.0, 1.0 - m[0][0] + m[1][1] - m[2][2])) / 2.0, m[0][2] - m[2][0])
    z = math.copysign(
        math.sqrt(max(0.0, 1.0 - m[0][0] - m[1][1] + m[2][2])) / 2.0, m[1][0] - m[0][1])
    return normalised([x, y, z, w])


def write_path(folder, name, shows, loop_s, views):
    positions = [position for position, _ in views]
    targets = [target for _, target in views]
    count = round(loop_s / PERIOD_S)
    lines = [
        f"# Courtyard, {shows}.", "# Written by assets/author/paths.py.", "diptych-path 1",
        f"period {PERIOD_S:.9g}"
    ]
    for i in range(count):
        position = closed_curve(positions, i / count)
        orientation = looking(position, closed_curve(targets, i / count))
        lines.append(" ".join(f"{value:.6f}"
                              for value in position) + "  " + " ".join(f"{value:.9f}"
                                                                       for value in orientation))
    (folder / f"{name}.pth").write_text("\n".join(lines) + "\n")


if __name__ == "__main__":
    for path_name, path in PATHS.items():
        write_path(pathlib.Path(sys.argv[1]), path_name, *path)
