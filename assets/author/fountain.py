"""The fountain: an octagonal basin and two bowls, each with its pool, under a finial."""
import math

import numpy as np

from geometry import Part

ABSORPTION_PER_M = np.array((1.9, 0.5, 0.65))  # of red, green and blue light, in the water
WET = 0.62  # how much of its light wet stone keeps
WATER_M = (0.66, 2.30, 3.33)  # levels of the pools; lowest: FOUNTAIN_WATER_LEVEL of the ini
OCTAGON = dict(segments=8, start_deg=22.5, flat=True)


def basin(part):
    # Radii are to the corners; the sides lie at 0.924 of them.
    part.lathe("carved", [(3.85, 0.0), (3.84, 0.16), (3.42, 0.16)], **OCTAGON)
    part.lathe("carved", [(3.42, 0.16), (3.41, 0.32), (3.10, 0.32)], **OCTAGON)
    part.lathe("carved", [(3.15, 0.32), (3.03, 0.47), (3.02, 0.70), (3.20, 0.82),
                          (3.20, 0.94), (2.745, 0.94), (2.74, 0.30)], **OCTAGON)


def panels_and_posts(part):
    """A sunk panel on each side and a post at each corner of the basin."""
    for k in range(8):
        with part.placed(turn_deg=45.0 * k):
            face, half = -3.02 * 0.92388, 0.82
            for x0, x1, z0, z1, skip in ((-half, half, 0.49, 0.53, "blrd"),
                                         (-half, half, 0.65, 0.69, "blrt"),
                                         (-half, -half + 0.05, 0.53, 0.65, "bltd"),
                                         (half - 0.05, half, 0.53, 0.65, "brtd")):
                part.box("carved", (x0, face - 0.035, z0), (x1, face, z1), skip)
        with part.placed(turn_deg=45.0 * k + 22.5):
            part.box("carved", (-0.17, -3.26, 0.16), (0.17, -2.86, 0.99), "td")
            part.box("carved", (-0.21, -3.30, 0.99), (0.21, -2.82, 1.07), "d")


def pedestal(part):
    part.lathe("carved", [(0.95, 0.30), (0.95, 0.74), (0.86, 0.79)],
               8,
               start_deg=22.5,
               flat=True)
    part.lathe("carved", [(0.86, 0.79), (0.75, 0.84), (0.59, 0.935), (0.45, 1.08), (0.37, 1.30),
                          (0.37, 1.48), (0.43, 1.63)], 24)
    part.lathe("carved", [(0.43, 1.63), (0.48, 1.66), (0.475, 1.705), (0.40, 1.74)],
               24, smooth_deg=80.0)


def large_bowl(part):
    part.lathe("carved", [(0.38, 1.722), (0.80, 1.815), (1.15, 1.96), (1.38, 2.125), (1.49, 2.27)],
               32)
    part.lathe("carved", [(1.49, 2.27), (1.57, 2.30), (1.595, 2.36), (1.55, 2.40), (1.43, 2.35),
                          (1.36, 2.25)], 32, smooth_deg=80.0)


def small_bowl(part):
    part.lathe("carved", [(0.34, 2.20), (0.34, 2.35), (0.27, 2.42), (0.20, 2.55), (0.175, 2.72),
                          (0.23, 2.95)], 16)
    part.lathe("carved", [(0.23, 2.95), (0.265, 2.985), (0.20, 3.03)], 16)
    part.lathe("carved", [(0.18, 3.015), (0.44, 3.07), (0.68, 3.185), (0.80, 3.33)], 28)
    part.lathe("carved", [(0.80, 3.33), (0.85, 3.37), (0.80, 3.41), (0.73, 3.36), (0.66, 3.28)],
               28, smooth_deg=80.0)


def finial(part):
    part.lathe("carved", [(0.17, 3.30), (0.17, 3.42), (0.10, 3.51), (0.10, 3.60), (0.18, 3.66),
                          (0.12, 3.70)], 12)
    # A pine cone of stone: rings of scales.
    cone = [(0.12, 3.70)]
    for k in range(5):
        t = (k + 0.5) / 5
        r = 0.185 * (1 - t**2.2) + 0.02
        z = 3.72 + 0.42 * t
        cone += [(r, z), (r * 0.84, z + 0.05)]
    part.lathe("carved", cone[:-1] + [(0.0, 4.22)], 10)


def fountain():
    part = Part("fountain")
    basin(part)
    panels_and_posts(part)
    pedestal(part)
    large_bowl(part)
    small_bowl(part)
    finial(part)
    with part.density(0.3):
        part.disc("carved", 2.76, 0.31, 8, 22.5)
    return part


def water():
    """The three pools, which are tagged as water. The reflection is right for the lowest."""
    part = Part("water")
    part.disc("water", 2.745, WATER_M[0], 8, 22.5)
    part.disc("water", 1.39, WATER_M[1], 24)
    part.disc("water", 0.70, WATER_M[2], 16)
    return part


def light_on(water, pool, near, far):
    """Returns spot(point) for Part.lit_as: the light on the water above a point, within the
    distances near to far from the axis, where nothing covers the water."""
    surface = water.surfaces["water"]
    corners = [i for i, chart in enumerate(surface.charts) if chart == pool][:3]
    places = np.array([surface.positions[i][:2] for i in corners])
    uvs = np.array([surface.chart_uvs[i] for i in corners])
    to_uv = np.linalg.solve(places[1:] - places[0], uvs[1:] - uvs[0])

    def spot(point):
        at = np.asarray(point, float)[:2]
        radius = np.hypot(*at)
        at = at * (min(max(radius, near), far) / radius)
        return pool, tuple(uvs[0] + (at - places[0]) @ to_uv)

    return spot


def pools(water):
    """What the water shows of the pools: their walls and floors below the surface. They have the
    light of the water's surface; they are wet, and water above them takes away most of the red and
    some blue."""
    part = Part("pools", light_of="water")
    low, middle, high = WATER_M
    with part.lit_as(light_on(water, 0, 1.06, 2.62)):
        part.lathe("pool", [(2.738, low), (2.735, 0.32)], **OCTAGON)
        part.lathe("pool", [(2.735, 0.32), (1.8, 0.318), (0.94, 0.316)], **OCTAGON)
        part.lathe("pool", [(0.953, 0.316), (0.953, low)], **OCTAGON)
    with part.lit_as(light_on(water, 1, 0.46, 1.30)):
        part.lathe("pool",
                   [(1.388, middle), (1.33, 2.17), (1.16, 2.05), (0.84, 1.95), (0.33, 1.90)],
                   32,
                   smooth_deg=80.0)
        part.lathe("pool", [(0.343, 1.90), (0.343, middle)], 16)
    with part.lit_as(light_on(water, 2, 0.26, 0.62)):
        part.lathe("pool", [(0.698, high), (0.62, 3.22), (0.42, 3.13), (0.16, 3.09)], 28,
                   smooth_deg=80.0)
        part.lathe("pool", [(0.172, 3.09), (0.172, high)], 12)
    surface = part.surfaces["pool"]
    levels = [next(level for level in WATER_M if z <= level + 1e-9)
              for _, _, z in surface.positions]
    depths = np.array(levels) - np.array(surface.positions)[:, 2]
    surface.colours = [tuple(c) for c in WET * np.exp(-2.0 * depths[:, None] * ABSORPTION_PER_M)]
    return part


def post_ball():
    """A stone ball for the posts of the basin, with its foot at z = 0."""
    part = Part("post_ball")
    ball = [(0.15 * math.sin(a), 0.17 - 0.15 * math.cos(a))
            for a in (math.pi * (0.16 + 0.84 * k / 6) for k in range(7))]
    part.lathe("carved", [(0.12, 0.0)] + ball[:-1] + [(0.0, 0.32)], 12)
    return part
