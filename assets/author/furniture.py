"""Pots, benches, lamps."""

from geometry import Part


def pot(part, size):
    """A terracotta pot with a rim, a garland and soil; size 1 is 0.74 m high."""
    s = size
    part.lathe("terracotta", [(r * s, z * s) for r, z in ((0.28, 0.0), (0.34, 0.25), (0.40, 0.54))],
               14)
    part.lathe("terracotta", [(r * s, z * s) for r, z in ((0.40, 0.54), (0.465, 0.58), (0.48, 0.69),
                                                          (0.455, 0.74), (0.40, 0.72))],
               14, smooth_deg=60.0)
    part.disc("soil", 0.41 * s, 0.715 * s, 8)


def bench():
    """A stone slab on two scrolled feet, along x."""
    part = Part("bench")
    part.box("carved", (-0.95, -0.26, 0.42), (0.95, 0.26, 0.50), "")
    part.box("carved", (-0.92, -0.23, 0.38), (0.92, 0.23, 0.42), "t")
    for x in (-0.66, 0.66):
        part.box("carved", (x - 0.13, -0.21, 0.0), (x + 0.13, 0.21, 0.07), "d")
        part.box("carved", (x - 0.09, -0.17, 0.07), (x + 0.09, 0.17, 0.31), "dt")
        part.box("carved", (x - 0.12, -0.20, 0.31), (x + 0.12, 0.20, 0.38), "t")
    return part


def lamp_post():
    part = Part("lamp_post")
    part.lathe("iron", [(0.20, 0.0), (0.20, 0.08), (0.155, 0.12), (0.15, 0.30), (0.075, 0.48),
                        (0.06, 0.80), (0.078, 0.86), (0.05, 0.92), (0.040, 2.75), (0.07, 2.82),
                        (0.035, 2.89), (0.05, 3.0)], 8)
    with part.placed(z=3.0):
        lantern(part)
    return part


def lantern(part):
    """A lantern: six panes between an iron foot and an iron roof."""
    part.lathe("iron", [(0.03, 0.0), (0.13, 0.06)], 6, flat=True)
    part.lathe("lamp", [(0.115, 0.06), (0.165, 0.42)], 6, flat=True)
    for k in range(6):
        with part.placed(turn_deg=60.0 * k):
            lower, upper = [(0.118, s * 0.012, 0.06) for s in (-1, 1)], [(0.172, s * 0.012, 0.42)
                                                                         for s in (-1, 1)]
            part.polygon("iron", [lower[0], lower[1], upper[1], upper[0]])
    part.lathe("iron", [(0.20, 0.41), (0.21, 0.44), (0.05, 0.60), (0.0, 0.74)],
               6,
               flat=True)


def wall_lantern():
    """A lantern on an arm from a wall at y = 0 towards -y; z = 0 at the lantern's foot."""
    part = Part("wall_lantern")
    part.box("iron", (-0.06, -0.03, -0.16), (0.06, 0.0, 0.22), "b")
    part.box("iron", (-0.018, -0.30, -0.06), (0.018, -0.03, -0.02), "b")
    with part.placed(y=-0.30, z=-0.02):
        lantern(part)
    return part
