"""The fountain: an octagonal basin and two bowls, each with its pool, under a finial."""
import math

from geometry import Part

WATER_M = (0.66, 2.30, 3.33)  # of the pools; the lowest is the ini's FOUNTAIN_WATER_LEVEL
OCTAGON = dict(segments=8, start_deg=22.5, flat=True)


def basin(part):
    # Radii are to the corners; the sides lie at 0.924 of them.
    part.lathe("carved", [(3.85, 0.0), (3.85, 0.13), (3.82, 0.16), (3.42, 0.16)], **OCTAGON)
    part.lathe("carved", [(3.42, 0.16), (3.42, 0.29), (3.39, 0.32), (3.16, 0.32)], **OCTAGON)
    part.lathe("carved", [(3.16, 0.32), (3.16, 0.38), (3.12, 0.42), (3.06, 0.44), (3.02, 0.48),
                          (3.02, 0.70), (3.06, 0.74), (3.12, 0.76), (3.20, 0.83), (3.20, 0.92),
                          (3.17, 0.94), (2.76, 0.94), (2.74, 0.92), (2.74, 0.30)], **OCTAGON)


def panels_and_posts(part):
    """A sunk panel on each side and a post at each corner of the basin."""
    for k in range(8):
        with part.placed(turn_deg=45.0 * k):
            face, half = -3.02 * 0.92388, 0.82
            for x0, x1, z0, z1 in ((-half, half, 0.49, 0.53), (-half, half, 0.65, 0.69),
                                   (-half, -half + 0.05, 0.53, 0.65), (half - 0.05, half, 0.53,
                                                                       0.65)):
                part.box("carved", (x0, face - 0.035, z0), (x1, face, z1), "b")
        with part.placed(turn_deg=45.0 * k + 22.5):
            part.box("carved", (-0.17, -3.26, 0.16), (0.17, -2.86, 0.99), "d")
            part.box("carved", (-0.21, -3.30, 0.99), (0.21, -2.82, 1.07), "")


def pedestal(part):
    part.lathe("carved", [(0.95, 0.30), (0.95, 0.72), (0.93, 0.76), (0.86, 0.79)],
               8,
               start_deg=22.5,
               flat=True)
    part.lathe("carved", [(0.86, 0.79), (0.78, 0.80), (0.76, 0.84), (0.70, 0.88), (0.58, 0.94),
                          (0.48, 1.03), (0.41, 1.15), (0.37, 1.30), (0.36, 1.44), (0.39, 1.56),
                          (0.43, 1.63)], 40)
    part.lathe("carved", [(0.43, 1.63), (0.47, 1.65), (0.48, 1.68), (0.47, 1.71), (0.42, 1.73)], 40)


def large_bowl(part):
    part.lathe("carved", [(0.42, 1.73), (0.60, 1.765), (0.80, 1.82), (1.00, 1.89), (1.18, 1.98),
                          (1.33, 2.08), (1.44, 2.19), (1.49, 2.27)], 48)
    part.lathe("carved", [(1.49, 2.27), (1.55, 2.29), (1.585, 2.32), (1.595, 2.355), (1.58, 2.385),
                          (1.53, 2.40), (1.47, 2.385), (1.43, 2.35)], 48)
    part.lathe("carved", [(1.43, 2.35), (1.36, 2.25), (1.20, 2.15), (0.9, 2.06), (0.5, 2.02)], 48)


def small_bowl(part):
    part.lathe("carved", [(0.34, 2.03), (0.34, 2.34), (0.31, 2.38), (0.25, 2.44), (0.20, 2.55),
                          (0.175, 2.68), (0.175, 2.80), (0.20, 2.90), (0.23, 2.95)], 28)
    part.lathe("carved", [(0.23, 2.95), (0.26, 2.965), (0.265, 2.99), (0.25, 3.015), (0.22, 3.025)],
               28)
    part.lathe("carved", [(0.22, 3.025), (0.40, 3.06), (0.57, 3.12), (0.70, 3.20), (0.78, 3.29),
                          (0.80, 3.33)], 36)
    part.lathe("carved", [(0.80, 3.33), (0.835, 3.345), (0.85, 3.375), (0.84, 3.40), (0.80, 3.41),
                          (0.755, 3.39), (0.73, 3.36)], 36)
    part.lathe("carved", [(0.73, 3.36), (0.66, 3.28), (0.5, 3.21), (0.2, 3.17)], 36)


def finial(part):
    part.lathe("carved", [(0.17, 3.17), (0.17, 3.42), (0.15, 3.45), (0.105, 3.50), (0.095, 3.58),
                          (0.12, 3.63), (0.17, 3.65), (0.18, 3.67), (0.17, 3.69), (0.12, 3.70)], 20)
    # A pine cone of stone: rings of scales.
    cone = [(0.12, 3.70)]
    for k in range(6):
        t = (k + 0.5) / 6
        r = 0.185 * (1 - t**2.2) + 0.02
        z = 3.72 + 0.42 * t
        cone += [(r, z), (r * 0.86, z + 0.042)]
    part.lathe("carved", cone + [(0.0, 4.22)], 16)


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
    """The three pools. Tagged as water; the lowest mirrors the court."""
    part = Part("water")
    part.disc("water", 2.745, WATER_M[0], 8, 22.5)
    part.disc("water", 1.405, WATER_M[1], 48)
    part.disc("water", 0.705, WATER_M[2], 36)
    return part


def post_ball():
    """A stone ball for the basin's posts; its foot at z = 0."""
    part = Part("post_ball")
    ball = [(0.15 * math.sin(a), 0.17 - 0.15 * math.cos(a))
            for a in (math.pi * (0.16 + 0.84 * k / 9) for k in range(10))]
    part.lathe("carved", [(0.12, 0.0), (0.075, 0.035)] + ball[:-1] + [(0.0, 0.32)], 14)
    return part
