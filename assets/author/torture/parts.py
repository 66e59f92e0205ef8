"""The parts of the torture scene: what stands on the quays and what hangs above them."""
import math
import random

import numpy as np

import art
from mesh import Mesh, unit

WATER_M = -0.9  # height of the canal's surface
SPAN_M = 12.0  # from mast to mast of the tramway
WIRE_Z = 8.0  # where the tramway's wire hangs


def sag(a, b, depth, count):
    """Points of a wire between two points, as a parabola."""
    a, b = np.asarray(a, float), np.asarray(b, float)
    return [a + (b - a) * t - np.array([0, 4 * depth * t * (1 - t), 0])
            for t in (i / count for i in range(count + 1))]


# --- wires ---------------------------------------------------------------------------------------


def lattice(mesh, material, foot, top, height, levels, leg, brace, base=0.0):
    """Four legs that lean towards each other, and two diagonals for each side of each level."""

    def corner(k, t):
        half = foot + (top - foot) * t
        return np.array([(-1, 1, 1, -1)[k] * half, base + height * t, (1, 1, -1, -1)[k] * half])

    for k in range(4):
        mesh.bar(material, [corner(k, 0), corner(k, 1)], leg)
        for i in range(levels):
            # The levels become lower upwards, as the lattice becomes narrower.
            lower, upper = (1 - (1 - j / levels)**1.25 if top < foot else j / levels
                            for j in (i, i + 1))
            mesh.bar(material, [corner(k, lower), corner((k + 1) % 4, upper)], brace, 3)
            mesh.bar(material, [corner((k + 1) % 4, lower), corner(k, upper)], brace, 3)


def mast():
    """A mast of the tramway with an arm over the rails. It stands at the origin."""
    mesh = Mesh("mast")
    lattice(mesh, "mast", 0.17, 0.13, 7.4, 13, 0.022, 0.008)
    reach = 10.2 - WIRE_Z
    mesh.bar("mast", [(0, 6.95, 0), (0, 6.75, -reach)], 0.025)
    mesh.bar("mast", [(0, 5.75, 0), (0, 6.72, -reach + 0.2)], 0.018)
    mesh.bar("mast", [(0, 5.75, 0), (0, 5.5, -reach)], 0.014)
    mesh.box("mast", (-0.3, 0, -0.3), (0.3, 0.14, 0.3), "b")
    with mesh.at(0, 0, -reach):
        for y in (6.62, 6.54, 6.46):
            mesh.lathe("white", [(0.0, y - 0.03, 0, -1), (0.055, y, 1, 0), (0.0, y + 0.03, 0, 1)],
                       8)
    return mesh


def catenary():
    """One span of the tramway's wires, from x = 0 to SPAN_M at z = 0."""
    mesh = Mesh("catenary")
    carrier = sag((0, 6.43, 0), (SPAN_M, 6.43, 0), 0.62, 12)
    mesh.bar("dark", carrier, 0.0055, 3)
    mesh.bar("dark", [(0, 5.5, 0), (SPAN_M, 5.5, 0)], 0.0075, 3)
    for i in range(1, 12, 2):
        x, y, _ = carrier[i]
        mesh.bar("dark", [(x, 5.5, 0), (x, y, 0)], 0.003, 3)
    return mesh


ARMS = ((17.5, 3.6), (20.5, 4.6), (23.5, 3.2))  # height and reach of a pylon's cross-arms


def pylon():
    mesh = Mesh("pylon")
    lattice(mesh, "mast", 2.4, 0.55, 16.0, 8, 0.075, 0.032)
    lattice(mesh, "mast", 0.55, 0.25, 10.5, 8, 0.06, 0.026, 16.0)
    for height, reach in ARMS:
        for side in (-1, 1):
            tip = (0, height, side * reach)
            for x in (-0.4, 0.4):
                mesh.bar("mast", [(x, height, side * 0.4), tip], 0.045)
                mesh.bar("mast", [(x, height + 0.9, side * 0.4), tip], 0.035)
            for k in range(1, 4):
                at = side * (0.4 + (reach - 0.4) * k / 4)
                mesh.bar("mast", [(0, height, at), (0, height + 0.9 * (1 - k / 4), at)], 0.02, 3)
            mesh.bar("dark", [tip, (0, height - 1.5, side * reach)], 0.05, 5)
    return mesh


def power_line(feet):
    """The conductors between pylons that stand at the points (x, z) of `feet` and face along x."""
    mesh = Mesh("power_line")
    for (x0, z0), (x1, z1) in zip(feet, feet[1:]):
        length = math.hypot(x1 - x0, z1 - z0)
        wires = [(height - 1.5, side * reach) for height, reach in ARMS for side in (-1, 1)]
        for y, z in wires + [(26.5, 0.0)]:
            mesh.bar("dark", sag((x0, y, z0 + z), (x1, y, z1 + z), 0.0006 * length * length, 16),
                     0.018, 3)
    return mesh


def railing():
    """Three metres of railing along x."""
    mesh = Mesh("railing")
    for x in (0.0, 1.5):
        mesh.bar("dark", [(x, 0, 0), (x, 1.08, 0)], 0.022, 6)
    for y, radius in ((1.1, 0.024), (0.14, 0.014)):
        mesh.bar("dark", [(0, y, 0), (3, y, 0)], radius, 6)
    for i in range(24):
        x = 0.0625 + 0.125 * i
        mesh.bar("dark", [(x, 0.14, 0), (x, 1.1, 0)], 0.007, 3)
    return mesh


# --- foliage -------------------------------------------------------------------------------------


def tree(seed, crowns, trunk_m):
    """A trunk and balls of leaf cards around dark cores. crowns: (centre, radius, cards)."""
    mesh = Mesh(f"tree_{seed}")
    rng = random.Random(seed)
    mesh.bar("bark", [(0, -0.1, 0), (0.05, 0.6 * trunk_m, 0.02), (0.0, trunk_m, 0.0)], 0.13, 8)
    golden = math.pi * (3 - math.sqrt(5))
    for (cx, cy, cz), radius, count in crowns:
        mesh.bar("bark", [(0, 0.72 * trunk_m, 0), (cx, cy, cz)], 0.05, 5, (0.8, 0.8, 0.8))
        core = 0.56 * radius
        body = [(core * math.sin(a), -core * math.cos(a), math.sin(a), 0.4 - math.cos(a))
                for a in (math.pi * i / 4 for i in range(5))]
        with mesh.at(cx, cy, cz):
            mesh.lathe("core", body, 7, (0.8, 0.8, 0.8))
        for i in range(count):
            y = 1 - 2 * (i + 0.5) / count
            r, a = math.sqrt(1 - y * y), golden * i
            out = np.array([r * math.cos(a), y, r * math.sin(a)])
            depth = rng.uniform(0.74, 1.04)
            light = (0.40 + 0.6 * depth) * (0.58 + 0.42 * (y + 1) / 2) * rng.uniform(0.85, 1.0)
            tint = rng.uniform(0.9, 1.08)
            facing = out + np.array([rng.uniform(-0.6, 0.6) for _ in range(3)])
            mesh.card("leaf", np.array((cx, cy, cz)) + radius * depth * out, facing,
                      rng.uniform(0, 6.28), radius * rng.uniform(0.52, 0.7), unit(out + (0, 0.35, 0)),
                      (min(1, light * tint), light, 0.9 * light))
    return mesh


def net_fence():
    """Three metres of wire netting along x, between posts."""
    mesh = Mesh("net_fence")
    for x in (0.0,):
        mesh.bar("mast", [(x, 0, 0), (x, 2.05, 0)], 0.03, 6)
    mesh.bar("mast", [(0, 2.0, 0), (3, 2.0, 0)], 0.016, 5)
    s = 1 / 0.16  # a picture is two meshes of 8 cm
    mesh.flat("net", [(0, 0.04, 0), (3, 0.04, 0), (3, 1.98, 0), (0, 1.98, 0)],
              [(0, 0), (3 * s, 0), (3 * s, 1.94 * s), (0, 1.94 * s)])
    return mesh


# --- metal ---------------------------------------------------------------------------------------

WAVE_M, DEPTH_M = 0.25, 0.014  # height and depth of the steel's waves


def waves(count, steps):
    """Depth and height of points on waves, and the upward slope of the normal there."""
    for i in range(count * steps + 1):
        a = 2 * math.pi * i / steps
        yield (DEPTH_M * math.sin(a), WAVE_M * i / steps,
               -DEPTH_M * 2 * math.pi / WAVE_M * math.cos(a))


def cladding(width, count):
    """Rolled steel in level waves in the plane z = 0, in panels of 6 m."""
    mesh = Mesh("cladding")
    rows = list(waves(count, 8))
    for x in range(0, width, 6):
        for (z0, y0, n0), (z1, y1, n1) in zip(rows, rows[1:]):
            mesh.face("cladding", [(x, y0, z0), (x + 5.97, y0, z0), (x + 5.97, y1, z1),
                                   (x, y1, z1)], [(0, n0, 1)] * 2 + [(0, n1, 1)] * 2)
    return mesh


def hall():
    """The body of the hall, without its cladding: x from 0 to 24, z from -12 to 0."""
    mesh = Mesh("hall")
    mesh.box("ashlar", (-0.05, 0, -12.05), (24.05, 0.7, 0.05), "b", 0.6)
    for x in (2.5, 11.0):
        mesh.box("dark", (x, 0.02, 0.02), (x + 4.2, 3.9, 0.09), "kb")
        mesh.box("red", (x + 0.15, 0.02, 0.05), (x + 4.05, 3.75, 0.11), "kb", 0.75)
    mesh.box("white", (-0.1, 5.9, -0.1), (24.1, 6.15, 0.16), "")
    roof = [(0, 6.1, 0.25), (24, 6.1, 0.25), (24, 8.0, -6), (0, 8.0, -6)]
    mesh.flat("mast", roof)
    mesh.flat("mast", [(24, 6.1, -12.25), (0, 6.1, -12.25), (0, 8.0, -6), (24, 8.0, -6)])
    mesh.flat("brick", [(0, 0.7, -12), (0, 0.7, 0), (0, 6.1, 0), (0, 8.0, -6), (0, 6.1, -12)])
    mesh.flat("brick", [(24, 0.7, 0), (24, 0.7, -12), (24, 6.1, -12), (24, 8.0, -6), (24, 6.1, 0)])
    return mesh


def silo():
    """A container of rings, with a cone on top and a ladder."""
    mesh = Mesh("silo")
    profile = [(1.7 + z, 0.5 + y, 1.0, n) for z, y, n in waves(22, 6)]
    mesh.lathe("steel", profile, 32)
    mesh.lathe("steel", [(1.74, 6.0, 0.5, 0.87), (0.25, 6.85, 0.5, 0.87), (0.0, 6.9, 0.0, 1.0)],
               32)
    mesh.lathe("ashlar", [(1.85, 0.0, 1, 0), (1.85, 0.5, 1, 0), (0.1, 0.5, 0, 1)], 24)
    for side in (-0.22, 0.22):
        mesh.bar("dark", [(side, 0.3, 1.95), (side, 6.2, 1.95)], 0.016)
    for i in range(20):
        mesh.bar("dark", [(-0.22, 0.5 + 0.28 * i, 1.95), (0.22, 0.5 + 0.28 * i, 1.95)], 0.01, 3)
    return mesh


def pipes():
    """A stack of pipes that lie along x."""
    mesh = Mesh("pipes")
    radius, rng = 0.14, random.Random(5)
    for row, count in enumerate((8, 7, 6)):
        for i in range(count):
            y = radius + row * radius * math.sqrt(3)
            z = (i - (count - 1) / 2) * 2 * radius
            x0 = rng.uniform(-0.12, 0.12)
            material = "copper" if row == 2 or (row + 2 * i) % 7 == 3 else "chrome"
            mesh.bar(material, [(x0 - 2.6, y, z), (x0 + 2.6, y, z)], radius, 16)
            for x, order in ((x0 - 2.6, -1), (x0 + 2.6, 1)):
                ring = [(x, y + 0.93 * radius * math.cos(a), z + 0.93 * radius * math.sin(a))
                        for a in (2 * math.pi * k / 12 for k in range(12))]
                mesh.flat("dark", ring[::order])
    for x in (-1.7, 1.7):
        for side in (-1, 1):
            mesh.box("mast", (x - 0.03, 0, side * 1.2 - 0.03), (x + 0.03, 0.7, side * 1.2 + 0.03),
                     "b")
    return mesh


def bollard():
    mesh = Mesh("bollard")
    mesh.lathe("chrome", [(0.10, 0.0, 1, 0), (0.10, 0.78, 1, 0), (0.10, 0.80, 1, 0.1),
                          (0.15, 0.86, 0.9, -0.3), (0.155, 0.92, 1, 0.3), (0.11, 0.99, 0.6, 0.8),
                          (0.0, 1.02, 0, 1)], 16)
    mesh.lathe("dark", [(0.19, 0.0, 1, 0), (0.19, 0.04, 1, 0), (0.10, 0.05, 0, 1)], 16)
    return mesh


# --- text ----------------------------------------------------------------------------------------


def panel(mesh, part, low, high, back="dark"):
    """A text that faces +z, with a case behind it."""
    (x0, y0), (x1, y1) = low, high
    mesh.flat("text", [(x0, y0, 0.0), (x1, y0, 0.0), (x1, y1, 0.0), (x0, y1, 0.0)],
              art.part_uvs(part))
    mesh.box(back, (x0 - 0.06, y0 - 0.06, -0.12), (x1 + 0.06, y1 + 0.06, -0.01), "")


def board(part, width, height, foot_m):
    """A text on two feet."""
    mesh = Mesh(f"board_{part[0]}_{part[1]}_{round(10 * width)}_{round(10 * foot_m)}")
    panel(mesh, part, (-width / 2, foot_m), (width / 2, foot_m + height))
    for x in (-width / 2 + 0.15, width / 2 - 0.15):
        mesh.bar("mast", [(x, 0, -0.07), (x, foot_m, -0.07)], 0.04, 6)
    return mesh


def lettered_ground():
    """Two words on the ground, to be read by those who come along +x."""
    mesh = Mesh("lettered_ground")
    mesh.flat("paint", [(0, 0.006, -0.9), (0, 0.006, 0.9), (4.2, 0.006, 0.9), (4.2, 0.006, -0.9)],
              [(0, 1), (1, 1), (1, 0), (0, 0)])
    return mesh


# --- the rest ------------------------------------------------------------------------------------


def house(wall, width, height, windows):
    """A house with a gable towards +z and windows in rows."""
    mesh = Mesh(f"house_{wall}_{round(10 * width)}_{round(10 * height)}")
    depth, ridge = 9.0, 0.36 * width
    mesh.box(wall, (-width / 2, 0, -depth), (width / 2, height, 0), "tb", 0.75)
    for z, order in ((0.0, 1), (-depth, -1)):
        mesh.flat(wall, [(-width / 2, height, z), (width / 2, height, z),
                         (0, height + ridge, z)][::order])
    for side in (-1, 1):
        eave, top = (side * (width / 2 + 0.3), height - 0.15), (0, height + ridge + 0.12)
        length = math.hypot(eave[0] - top[0], eave[1] - top[1])
        points = [(eave[0], eave[1], 0.3), (eave[0], eave[1], -depth - 0.3),
                  (top[0], top[1], -depth - 0.3), (top[0], top[1], 0.3)]
        uvs = [(0, length), (depth + 0.6, length), (depth + 0.6, 0), (0, 0)]
        mesh.flat("roof", points if side > 0 else points[::-1], uvs if side > 0 else uvs[::-1])
    columns, rows = windows
    for i in range(columns):
        for j in range(rows):
            x = width * ((i + 0.5) / columns - 0.5)
            y = 1.0 + (height - 0.6) * j / rows
            mesh.box("white", (x - 0.55, y, 0.0), (x + 0.55, y + 1.5, 0.05), "k")
            mesh.flat("window", [(x - 0.45, y + 0.1, 0.06), (x + 0.45, y + 0.1, 0.06),
                                 (x + 0.45, y + 1.4, 0.06), (x - 0.45, y + 1.4, 0.06)])
            mesh.bar("white", [(x, y + 0.1, 0.06), (x, y + 1.4, 0.06)], 0.022, 4)
            mesh.bar("white", [(x - 0.45, y + 0.95, 0.06), (x + 0.45, y + 0.95, 0.06)], 0.022, 4)
    return mesh


def hills(radius, height, seed, colour):
    """A ring of hills. Its lower edge is below the ground."""
    mesh = Mesh(f"hills_{seed}")
    rng = random.Random(seed)
    waves = [(k, rng.uniform(0, 6.28), rng.uniform(0.3, 1.0) / k**0.7) for k in (2, 3, 5, 8, 13, 21)]
    count = 96

    def top(i):
        a = 2 * math.pi * i / count
        return height * (1.1 + 0.42 * sum(w * math.sin(k * a + p) for k, p, w in waves))

    for i in range(count):
        a0, a1 = (2 * math.pi * j / count for j in (i + 1, i))
        (s0, c0), (s1, c1) = ((radius * math.sin(a), radius * math.cos(a)) for a in (a0, a1))
        mesh.face("hills", [(s0, -4, c0), (s1, -4, c1), (s1, top(i), c1), (s0, top(i + 1), c0)],
                  [(0, 1, 0)] * 4, None, [tuple(0.92 * c for c in colour)] * 2 + [colour] * 2)
    return mesh


def ship():
    """A barge on the canal, along x."""
    mesh = Mesh("ship")
    deck, keel = 0.55, WATER_M - 0.3
    outline = [(-6.2, -1.3), (5.0, -1.3), (6.6, 0.0), (5.0, 1.3), (-6.2, 1.3)]
    for (x0, z0), (x1, z1) in zip(outline, outline[1:] + outline[:1]):
        mesh.flat("dark", [(x1, keel, 0.9 * z1), (x0, keel, 0.9 * z0), (x0, WATER_M + deck, z0),
                           (x1, WATER_M + deck, z1)])
        mesh.bar("white", [(x0, WATER_M + deck, z0), (x1, WATER_M + deck, z1)], 0.05, 4)
    mesh.flat("red", [(x, WATER_M + deck - 0.04, z) for x, z in outline[::-1]])
    mesh.box("white", (-5.6, WATER_M + deck - 0.05, -0.95), (-3.2, WATER_M + 2.2, 0.95), "b", 0.8)
    mesh.box("window", (-5.3, WATER_M + 1.35, -0.97), (-3.5, WATER_M + 1.95, 0.97), "tb")
    mesh.bar("white", [(2.2, WATER_M + deck, 0), (2.2, WATER_M + 4.6, 0)], 0.035, 6)
    for x in (-3.2, 6.2):
        mesh.bar("dark", [(2.2, WATER_M + 4.5, 0), (x, WATER_M + deck + 0.3, 0)], 0.008, 3)
    return mesh
