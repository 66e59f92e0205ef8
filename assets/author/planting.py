"""Plants from leaf cards. Cards are lit by the direction out of the crown rather than by their own,
which shades a crown like a round body; vertex colours darken its inside and underside."""
import math
import random

import numpy as np

from geometry import Part, unit
from furniture import pot
from wing import ARCH_R, SPRING_M


def shaded(depth, low, tint, rng):
    """Vertex colour: depth 0 (inside) .. 1 (skin), low 0 (underside) .. 1 (top)."""
    light = (0.42 + 0.58 * depth) * (0.55 + 0.45 * low) * rng.uniform(0.88, 1.0)
    return tuple(min(1.0, light * t) for t in tint)


CORE = 0.78  # size of the core relative to the crown
SUNNY, SHADY = (1.0, 1.0, 1.0), (0.36, 0.42, 0.50)


def core(part, profile, segments, tint, centre=(0, 0, 0)):
    """A dark body inside a crown, turned about z, that hides its far side. profile: (radius, z),
    upwards from a point to a point. Lit as if it faced up a little, also below."""
    angles = [2 * math.pi * k / segments for k in range(segments)]
    rings = [[np.array((r * math.cos(a), r * math.sin(a), z)) for a in angles] for r, z in profile]
    out = [[unit((math.cos(a), math.sin(a), 0.4 + i / len(profile))) for a in angles]
           for i in range(len(profile))]
    for i in range(len(rings) - 1):
        for k in range(segments):
            j = (k + 1) % segments
            at = [(i, k), (i, j), (i + 1, j), (i + 1, k)]
            at = [at[c] for c in range(4) if profile[at[c][0]][0] > 0 or c in (0, 2)]
            part.face("foliage", [rings[r][c] + centre for r, c in at], [out[r][c] for r, c in at],
                      [(0, 0)] * len(at), -1, [(0, 0)] * len(at), tint)


def crown(part, centre, radius, height, count, size, tint, seed, flower_share=0.0):
    """A ball of cards around a dark core."""
    rng = random.Random(seed)
    r, h = CORE * radius, CORE * height
    core(part, [(0, -h), (0.87 * r, -0.5 * h), (0.87 * r, 0.5 * h), (0, h)], 6, tint, centre)
    golden = math.pi * (3 - math.sqrt(5))
    for i in range(count):
        z = 1 - 2 * (i + 0.5) / count
        r, a = math.sqrt(1 - z * z), golden * i
        out = np.array([r * math.cos(a), r * math.sin(a), z])
        depth = rng.uniform(0.84, 1.02)
        at = np.asarray(centre) + out * depth * np.array([radius, radius, height])
        facing = out + np.array([rng.uniform(-0.5, 0.5) for _ in range(3)])
        material = "flower" if 0.755 * i % 1 < flower_share else "leaf"
        part.card(material, at, facing, rng.uniform(0, 6.28), size * rng.uniform(0.85, 1.2),
                  unit(out + (0, 0, 0.35)), shaded(depth, (z + 1) / 2, tint, rng))


def tint_name(tint):
    return "shady" if tint is SHADY else "sunny"


def tree(tint=SUNNY):
    """A clipped tree in a large pot."""
    part = Part(f"tree_{tint_name(tint)}")
    pot(part, 1.1)
    part.lathe("wood", [(0.075, 0.68), (0.055, 1.2), (0.05, 2.1)], 7)
    for k in range(3):
        a = 2.1 * k
        crown(part, (0.26 * math.cos(a), 0.26 * math.sin(a), 2.35 + 0.12 * (k % 2)), 0.74, 0.68, 27,
              0.57, tint, 40 + k)
    return part


def flower_pot(tint=SUNNY):
    part = Part(f"flower_pot_{tint_name(tint)}")
    pot(part, 0.78)
    crown(part, (0, 0, 0.86), 0.44, 0.38, 44, 0.31, tint, 60, flower_share=0.75)
    return part


def topiary(tint=SUNNY):
    """A ball of box in a small pot."""
    part = Part(f"topiary_{tint_name(tint)}")
    pot(part, 0.62)
    crown(part, (0, 0, 0.82), 0.40, 0.40, 42, 0.29, tint, 70)
    return part


def flower_box(tint=SUNNY):
    """A plant that hangs below a window, in the wing's frame, with the sill at z = 0."""
    part = Part(f"flower_box_{tint_name(tint)}")
    part.box("terracotta", (-0.5, -0.40, -0.02), (0.5, -0.17, 0.19), "")
    rng = random.Random(80)
    for k in range(20):
        x = -0.46 + 0.92 * k / 19
        hang = rng.random()
        out = unit((rng.uniform(-0.4, 0.4), -1, 0.7 - hang))
        part.card("flower" if k % 3 else "leaf", (x, -0.28 - 0.14 * hang, 0.26 - 0.30 * hang), out,
                  rng.uniform(0, 6.28), rng.uniform(0.20, 0.28), unit(out + (0, 0, 0.6)),
                  shaded(1.0, 1 - 0.5 * hang, tint, rng))
    return part


def climber():
    """Bougainvillea on both walls of a corner: the origin is the corner, the walls' faces lie at
    y = 0 (towards -x) and x = 0 (towards -y)."""
    part = Part("climber")
    rng = random.Random(90)
    for x, y, lean in ((-0.55, -0.50, 0.0), (-0.62, -0.40, 60.0)):
        with part.placed(x, y, turn_deg=lean):
            part.lathe("wood", [(0.035, 0.0), (0.025, 1.2), (0.015, 3.0)], 4)
    for k in range(200):
        z = 0.4 + 7.6 * rng.random()**0.8
        spread = 0.30 + 1.9 * math.sin(math.pi * min(1.0, z / 7.2))**1.2
        off = min(abs(rng.gauss(0, 0.5)), 1.1) * spread
        if z < SPRING_M + ARCH_R:  # no further than the wall beside the arch
            off = min(off, 2.25 - math.sqrt(ARCH_R**2 - max(0.0, z - SPRING_M)**2))
        lift = 0.12 + 0.38 * rng.random()
        on_y = k % 2 == 0
        at = (-off, -lift, z) if on_y else (-lift, -off, z)
        wall = np.array((0.0, -1.0, 0.3) if on_y else (-1.0, 0.0, 0.3))
        facing = wall + np.array([rng.uniform(-0.6, 0.6) for _ in range(3)])
        material = "flower" if rng.random() < 0.68 else "leaf"
        part.card(material, at, facing, rng.uniform(0, 6.28), rng.uniform(0.38, 0.60),
                  unit(wall + (0, 0, 0.35)), shaded(0.3 + 1.4 * lift, 0.4 + 0.08 * z, SUNNY, rng))
    return part


def cypress(seed, height):
    """A tree outside the walls. Its lowest metres are never seen."""
    part = Part(f"cypress_{seed}")
    rng = random.Random(seed)
    dark = (0.62, 0.72, 0.66)
    core(part, [(0, 0.2), (0.6, 0.3 * height), (0.6, 0.6 * height), (0.3, 0.85 * height),
                (0, height - 0.3)], 5, dark)
    count = int(height * 8)
    for i in range(count):
        t = (i + 0.5) / count
        z = 0.6 + (height - 0.8) * t
        radius = 0.92 * math.sin(math.pi * min(0.97, 0.16 + 0.82 * t))**0.75 + 0.05
        a = 2.4 * i
        out = np.array([math.cos(a), math.sin(a), 0.25])
        depth = rng.uniform(0.75, 1.0)
        part.card("leaf", (out[0] * radius * depth, out[1] * radius * depth, z),
                  out + np.array([rng.uniform(-0.4, 0.4) for _ in range(3)]), rng.uniform(0, 6.28),
                  rng.uniform(0.75, 1.0) * (0.45 + 0.6 * radius), unit(out),
                  shaded(depth, 0.4 + 0.6 * t, dark, rng))
    return part
