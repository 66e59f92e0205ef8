#!/usr/bin/env python3
"""Writes the gallery's penguin: penguin.md2, with a waddle of 15 key frames, and its skin penguin.pcx.

Usage: penguin.py FOLDER. It needs Python only. The penguin looks along +x and stands on z = 0, as
the models of the games do. Its parts are spheres and cones, which a pose moves rigidly.
"""
import math
import os
import re
import struct
import sys

FRAMES = 15
SKIN = 256
HERE = os.path.dirname(os.path.abspath(__file__))


def read_normals():
    """The 162 unit vectors that an MD2 file numbers, from the loader's table."""
    text = open(os.path.join(HERE, "..", "md2_normals.c")).read()
    rows = re.findall(r"\{((?:-?\d+, ){5}-?\d+)\}", text)
    golden = (1 + math.sqrt(5)) / 2
    vectors = []
    for row in rows:
        n = [int(v) for v in row.split(", ")]
        v = [n[2 * i] + n[2 * i + 1] * golden for i in range(3)]
        size = math.sqrt(sum(c * c for c in v))
        vectors.append(tuple(c / size for c in v))
    assert len(vectors) == 162, len(vectors)
    return vectors


# --- parts -----------------------------------------------------------------------------------------


class Part:
    """Vertices in the part's own space, with texels, and triangles that wind counter-clockwise."""

    def __init__(self, name, region):
        self.name, self.region = name, region  # region: x, y, width, height in texels
        self.points, self.texels, self.triangles = [], [], []

    def lathe(self, profile, around):
        """Turns a profile of (radius, height) about the z axis, from the bottom to the top."""
        x0, y0, width, height = self.region
        for k, (radius, z) in enumerate(profile):
            for a in range(around + 1):
                angle = 2 * math.pi * a / around
                self.points.append((-radius * math.cos(angle), -radius * math.sin(angle), z))
                self.texels.append((x0 + 1 + (width - 3) * a / around,
                                    y0 + 1 + (height - 3) * (1 - k / (len(profile) - 1))))
        for k in range(len(profile) - 1):
            for a in range(around):
                low, high = k * (around + 1) + a, (k + 1) * (around + 1) + a
                if profile[k][0] > 0:
                    self.triangles.append((low, low + 1, high + 1))
                if profile[k + 1][0] > 0:
                    self.triangles.append((low, high + 1, high))
        return self

    def ball(self, size, around, steps):
        profile = [(math.sin(math.pi * k / steps), -math.cos(math.pi * k / steps))
                   for k in range(steps + 1)]
        profile[0], profile[-1] = (0.0, -1.0), (0.0, 1.0)
        self.lathe(profile, around)
        self.points = [(x * size[0], y * size[1], z * size[2]) for x, y, z in self.points]
        return self


def make_parts():
    body = [(0.0, 0.0), (0.20, 0.01), (0.33, 0.08), (0.41, 0.22), (0.44, 0.38), (0.43, 0.54),
            (0.39, 0.70), (0.33, 0.84), (0.26, 0.95), (0.21, 1.02), (0.0, 1.06)]
    parts = {
        "body": Part("body", (0, 0, 256, 128)).lathe(body, 24),
        "head": Part("head", (0, 128, 128, 64)).ball((0.27, 0.25, 0.26), 20, 12),
        "beak": Part("beak", (128, 128, 32, 32)).lathe(
            [(0.0, -0.02), (0.085, 0.0), (0.06, 0.09), (0.02, 0.20), (0.0, 0.21)], 12),
        "scarf": Part("scarf", (0, 192, 128, 32)).lathe(
            [(0.20, -0.05), (0.30, -0.03), (0.32, 0.02), (0.28, 0.07), (0.18, 0.08)], 24),
        "tail": Part("tail", (128, 160, 64, 32)).ball((0.06, 0.075, 0.24), 8, 6),
    }
    for side in ("left", "right"):
        parts["flipper " + side] = Part("flipper", (160, 128, 32, 32)).ball((0.13, 0.045, 0.34), 12, 8)
        parts["foot " + side] = Part("foot", (192, 128, 32, 32)).ball((0.21, 0.13, 0.055), 14, 6)
        parts["eye " + side] = Part("eye", (224, 128, 32, 32)).ball((0.045, 0.045, 0.05), 10, 6)
    return parts


# --- poses -----------------------------------------------------------------------------------------


def turned(p, axis, degrees):
    i, j = ((1, 2), (2, 0), (0, 1))[axis]
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    q = list(p)
    q[i], q[j] = c * p[i] - s * p[j], s * p[i] + c * p[j]
    return q


def moved(p, x, y, z):
    return [p[0] + x, p[1] + y, p[2] + z]


def pose_point(name, p, phase):
    """Takes a point of a part to the model's space. phase: time as an angle, a full turn per loop."""
    sway = math.sin(phase)
    side = 1.0 if name.endswith("left") else -1.0
    if name.startswith("foot"):
        step = math.sin(phase + (0.0 if side > 0 else math.pi))
        lift = max(0.0, math.cos(phase + (0.0 if side > 0 else math.pi)))
        p = turned(p, 1, -16.0 * lift)
        return moved(p, 0.10 + 0.15 * step, 0.19 * side, 0.055 + 0.11 * lift)
    if name.startswith("flipper"):
        flap = 24.0 + 16.0 * math.cos(2.0 * phase + (0.6 if side > 0 else 0.0))
        p = turned(moved(p, 0.0, 0.0, -0.30), 0, side * flap)
        p = moved(turned(p, 1, 10.0 * sway * side), 0.02, 0.34 * side, 0.86)
    elif name == "tail":
        p = moved(turned(p, 1, -58.0 + 0.0), -0.42, 0.0, 0.16)
        p = turned(p, 2, 12.0 * sway)
    elif name == "scarf":
        p = moved(p, 0.0, 0.0, 1.0)
    elif name != "body":
        if name == "beak":
            p = moved(turned(p, 1, 90.0), 0.24, 0.0, -0.03)
        if name.startswith("eye"):
            p = moved(p, 0.20, 0.115 * side, 0.07)
        p = turned(turned(p, 0, 9.0 * sway), 2, 14.0 * math.sin(phase + 0.8))
        p = moved(p, 0.03, 0.0, 1.20)
    p = turned(p, 0, -10.0 * sway)
    return moved(turned(p, 2, 8.0 * math.cos(phase)), 0.0, 0.05 * sway, 0.08 + 0.05 * abs(math.cos(phase)))


def smooth_normals(points, triangles):
    sums = {}
    keys = [tuple(round(c, 6) for c in p) for p in points]
    for t in triangles:
        a, b, c = (points[i] for i in t)
        u = [b[i] - a[i] for i in range(3)]
        v = [c[i] - a[i] for i in range(3)]
        n = (u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0])
        for i in t:
            total = sums.setdefault(keys[i], [0.0, 0.0, 0.0])
            for k in range(3):
                total[k] += n[k]
    return [sums.get(key, [0.0, 0.0, 1.0]) for key in keys]


# --- the skin --------------------------------------------------------------------------------------


def smooth(low, high, x):
    t = min(max((x - low) / (high - low), 0.0), 1.0)
    return t * t * (3 - 2 * t)


def mix(a, b, share):
    return tuple(p + (q - p) * share for p, q in zip(a, b))


def feather(x, y):
    return 0.5 + 0.5 * math.sin(0.9 * x + 2.0 * math.sin(0.35 * y)) * math.sin(1.1 * y)


def colour_at(x, y):
    """sRGB, 0..255, of a texel."""
    black, white, orange, red = (34, 38, 52), (240, 240, 232), (240, 150, 40), (196, 40, 44)
    if y < 128:  # the body: the front is in the middle of the region
        across = (x - 127.5) / 127.5
        up = 1 - y / 127.0
        edge = abs(across) - 0.40 * math.sqrt(max(0.0, 1 - ((up - 0.42) / 0.52) ** 2))
        own = mix(white, black, smooth(-0.02, 0.02, edge))
        return mix(own, (0, 0, 0), 0.10 * feather(x, y))
    if y < 192 and x < 128:  # the head, with white cheeks
        across, up = (x - 63.5) / 63.5, 1 - (y - 128) / 63.0
        cheek = math.hypot((abs(across) - 0.20) / 0.16, (up - 0.44) / 0.24)
        return mix(mix(white, black, smooth(0.92, 1.06, cheek)), (0, 0, 0), 0.08 * feather(x, y))
    if y >= 192:  # the scarf: stripes
        return mix(red, white, smooth(0.55, 0.75, math.sin(x * 2 * math.pi / 16)))
    if x < 160 and y < 160:
        return mix(orange, (200, 90, 20), (y - 128) / 32.0)
    if 160 <= x < 192 and y < 160:
        return mix(black, (70, 80, 104), smooth(8, 24, abs(x - 175.5)))
    if 192 <= x < 224 and y < 160:
        return mix(orange, (170, 80, 20), 0.5 + 0.5 * math.sin(x * 2 * math.pi / 8))
    if x >= 224 and y < 160:  # the eye: a white spot on black
        return mix((250, 250, 250), (12, 12, 16), smooth(3.0, 5.0, math.hypot(x - 236, y - 140)))
    return black


def write_pcx(path):
    """An 8-bit PCX picture with a palette of 6x7x6 colours, dithered in a fixed pattern."""
    levels = (6, 7, 6)
    rows = []
    for y in range(SKIN):
        row = bytearray()
        for x in range(SKIN):
            index = 0
            for c, n in zip(colour_at(x, y), levels):
                dither = (((x * 5 + y * 3) % 8) + 0.5) / 8 - 0.5
                step = int(min(max(c / 255 * (n - 1) + 0.5 + 0.8 * dither, 0), n - 1))
                index = index * n + step
            row.append(index)
        rows.append(bytes(row))
    out = bytearray(struct.pack("<BBBBHHHHHH48sBBHHHH54s", 10, 5, 1, 8, 0, 0, SKIN - 1, SKIN - 1,
                                72, 72, b"", 0, 1, SKIN, 1, 0, 0, b""))
    for row in rows:
        at = 0
        while at < len(row):
            run = 1
            while run < 63 and at + run < len(row) and row[at + run] == row[at]:
                run += 1
            if run > 1 or row[at] >= 192:
                out.append(192 | run)
            out.append(row[at])
            at += run
    palette = bytearray(768)
    for i in range(levels[0] * levels[1] * levels[2]):
        b, rest = i % levels[2], i // levels[2]
        g, r = rest % levels[1], rest // levels[1]
        for c, (value, n) in enumerate(zip((r, g, b), levels)):
            palette[3 * i + c] = round(255 * value / (n - 1))
    open(path, "wb").write(bytes(out) + b"\x0c" + bytes(palette))


# --- the model -------------------------------------------------------------------------------------


def write_md2(path):
    table = read_normals()
    parts = make_parts()
    texels, triangles = [], []
    start = 0
    for part in parts.values():
        texels += [(round(s), round(t)) for s, t in part.texels]
        # The games wind triangles clockwise.
        triangles += [(start + a, start + c, start + b) for a, b, c in part.triangles]
        start += len(part.points)
    frames = b""
    for f in range(FRAMES):
        phase = 2 * math.pi * f / FRAMES
        points = [pose_point(name, p, phase) for name, part in parts.items() for p in part.points]
        outward = [(a, c, b) for a, b, c in triangles]
        normals = smooth_normals(points, outward)
        low = [min(p[i] for p in points) for i in range(3)]
        scale = [(max(p[i] for p in points) - low[i]) / 255 for i in range(3)]
        frames += struct.pack("<6f16s", *scale, *low, b"waddle%03d" % f)
        for p, n in zip(points, normals):
            best = max(range(162), key=lambda k: sum(a * b for a, b in zip(table[k], n)))
            frames += struct.pack("<4B", *(min(255, round((p[i] - low[i]) / scale[i]))
                                           for i in range(3)), best)
    frame_bytes = 40 + 4 * start
    skins = struct.pack("<64s", b"penguin.pcx")
    st = b"".join(struct.pack("<2h", *t) for t in texels)
    faces = b"".join(struct.pack("<6H", *t, *t) for t in triangles)
    commands = struct.pack("<i", 0)
    offset = [68]
    for block in (skins, st, faces, frames, commands):
        offset.append(offset[-1] + len(block))
    header = struct.pack("<4s16i", b"IDP2", 8, SKIN, SKIN, frame_bytes, 1, start, len(texels),
                         len(triangles), 1, FRAMES, *offset[:6])
    open(path, "wb").write(header + skins + st + faces + frames + commands)
    print("penguin: %d vertices, %d triangles, %d frames" % (start, len(triangles), FRAMES))


def main():
    folder = sys.argv[1]
    os.makedirs(folder, exist_ok=True)
    write_pcx(os.path.join(folder, "penguin.pcx"))
    write_md2(os.path.join(folder, "penguin.md2"))


if __name__ == "__main__":
    main()
