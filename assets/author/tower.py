"""The campanile behind the north wing: brick between stone quoins, an open belfry, a tiled spire.
Its middle is the origin."""
import math

from geometry import Part

HALF_M = 2.2
BASE_M, BELFRY_M, SPRING_M, EAVE_M, TOP_M = 8.4, 14.35, 16.9, 19.3, 22.4
ARCH_R = 1.15


def belfry_face(part):
    """One side, facing -y at y = -HALF_M."""
    y, half = -HALF_M, HALF_M
    steps = 10
    with part.sheet("xz", 0.7):
        arc = [(-ARCH_R * math.cos(math.pi * k / steps),
                SPRING_M + ARCH_R * math.sin(math.pi * k / steps)) for k in range(steps + 1)]
        for a, b in zip(arc, arc[1:]):
            part.polygon("brick", [(a[0], y, a[1]), (b[0], y, b[1]), (b[0], y, EAVE_M),
                                   (a[0], y, EAVE_M)])
        for x0, x1 in ((-half, -ARCH_R), (ARCH_R, half)):
            for z0, z1 in ((BELFRY_M, SPRING_M), (SPRING_M, EAVE_M)):
                part.polygon("brick", [(x0, y, z0), (x1, y, z0), (x1, y, z1), (x0, y, z1)])
    with part.density(0.5):
        part.arch("carved", (0, SPRING_M), [(ARCH_R, y + 0.5), (ARCH_R, y - 0.06),
                                            (ARCH_R + 0.26, y - 0.06), (ARCH_R + 0.26, y)], steps)
        for side in (-1, 1):
            x = side * ARCH_R
            jamb = [(x, y, BELFRY_M), (x, y + 0.5, BELFRY_M), (x, y + 0.5, SPRING_M),
                    (x, y, SPRING_M)]
            part.polygon("carved", jamb if side < 0 else jamb[::-1])
            part.box("carved", (min(x, x + side * 0.3), y - 0.08, SPRING_M - 0.16),
                     (max(x, x + side * 0.3), y + 0.5, SPRING_M), "b")
        part.box("carved", (-ARCH_R, y + 0.02, BELFRY_M + 0.95),
                 (ARCH_R, y + 0.22, BELFRY_M + 1.07), "lr")
        part.box("carved", (-ARCH_R, y + 0.02, BELFRY_M), (ARCH_R, y + 0.22, BELFRY_M + 0.08),
                 "lrd")


def shaft_face(part):
    y, half = -HALF_M, HALF_M
    with part.density(0.6):
        part.polygon("brick", [(-half, y, BASE_M), (half, y, BASE_M), (half, y, BELFRY_M),
                               (-half, y, BELFRY_M)])
        # A blind round window with a stone rim.
        part.box("carved", (-0.62, y - 0.10, 11.0), (0.62, y, 11.14), "b")
        for x0, x1 in ((-0.52, -0.36), (0.36, 0.52)):
            part.box("carved", (x0, y - 0.06, 11.14), (x1, y, 12.4), "btd")
        part.arch("carved", (0, 12.4), [(0.36, y), (0.36, y - 0.06), (0.52, y - 0.06), (0.52, y)],
                  8)
        part.polygon("soil", [(-0.36, y - 0.01, 11.14), (0.36, y - 0.01, 11.14),
                              (0.36, y - 0.01, 12.4), (-0.36, y - 0.01, 12.4)])
        fan = [(0.36 * math.cos(math.pi * k / 8), y - 0.01,
                12.4 + 0.36 * math.sin(math.pi * k / 8)) for k in range(9)]
        part.polygon("soil", fan)


def quoins(part):
    """Alternating blocks on the corner at -x, -y."""
    z, k = BASE_M, 0
    while z < EAVE_M - 0.2:
        long, short = (0.62, 0.40) if k % 2 else (0.40, 0.62)
        part.box("carved", (-HALF_M - 0.05, -HALF_M - 0.05, z),
                 (-HALF_M + long, -HALF_M + short, z + 0.50), "t")
        z, k = z + 0.53, k + 1


def spire(part):
    y, half = -HALF_M - 0.45, HALF_M + 0.45
    rise = math.hypot(half, TOP_M - EAVE_M - 0.45)
    part.polygon("roof", [(-half, y, EAVE_M + 0.45), (half, y, EAVE_M + 0.45), (0, 0, TOP_M)],
                 [(-half, 0), (half, 0), (0, rise)])
    part.polygon("wood", [(-half, y, EAVE_M + 0.45), (-HALF_M, -HALF_M, EAVE_M + 0.44),
                          (HALF_M, -HALF_M, EAVE_M + 0.44), (half, y, EAVE_M + 0.45)])


def tower():
    part = Part("tower")
    for k in range(4):
        seen = 1.0 if k != 2 else 0.3  # the north side is never seen
        with part.placed(turn_deg=90.0 * k), part.density(seen):
            shaft_face(part)
            belfry_face(part)
            with part.density(0.4):
                quoins(part)
                for z in (10.0, 14.0):
                    part.moulding("carved", -HALF_M - 0.12, HALF_M + 0.12,
                                  [(-HALF_M, z), (-HALF_M - 0.12, z + 0.10),
                                   (-HALF_M - 0.12, z + 0.30)])
                part.moulding("carved", -HALF_M - 0.34, HALF_M + 0.34, [(-HALF_M, 18.95),
                                                                        (-HALF_M - 0.10, 19.12),
                                                                        (-HALF_M - 0.34, 19.42),
                                                                        (-HALF_M - 0.34, 19.75)])
                spire(part)
    with part.density(0.3):
        part.polygon("wood", [(-2.2, 2.2, 19.2), (2.2, 2.2, 19.2), (2.2, -2.2, 19.2),
                              (-2.2, -2.2, 19.2)])
        part.polygon("carved", [(-2.2, -2.2, BELFRY_M), (2.2, -2.2, BELFRY_M), (2.2, 2.2, BELFRY_M),
                                (-2.2, 2.2, BELFRY_M)])
        part.box("wood", (-2.0, -0.08, 17.9), (2.0, 0.08, 18.06), "lr")
        part.lathe("bronze", [(0.62, 16.75), (0.48, 16.98), (0.39, 17.30), (0.34, 17.62),
                              (0.06, 17.9)], 12)
        part.lathe("bronze", [(0.02, TOP_M - 0.1), (0.16, TOP_M), (0.16, TOP_M + 0.08),
                              (0.04, TOP_M + 0.2), (0.03, TOP_M + 1.35)], 6)
        part.box("bronze", (-0.32, -0.02, TOP_M + 0.85), (0.32, 0.02, TOP_M + 0.92), "")
    return part


def belfry_baluster():
    """Some 16 pixels high in the picture."""
    part = Part("belfry_baluster")
    part.lathe("carved", [(0.07, 0.0), (0.045, 0.12), (0.080, 0.30), (0.036, 0.68), (0.06, 0.87)],
               5)
    return part


def belfry_balusters():
    """(x, y, turn in degrees): seven on each side, those that face the court in the middle."""
    for k in (2, 3, 0, 1):
        a = math.radians(90.0 * k)
        for i in range(7):
            x, y = -0.96 + 0.32 * i, -HALF_M + 0.12
            yield x * math.cos(a) - y * math.sin(a), x * math.sin(a) + y * math.cos(a), 90.0 * k
