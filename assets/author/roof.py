"""Tiled roofs, in panels of two metres: eight rows of round tiles, rafter tails, the ridge."""
import math

from geometry import Part
from wing import EAVE_M

SLOPE = math.tan(math.radians(23.0))
OVERHANG_M, RIDGE_M, PANEL_M = 0.55, 4.2, 2.0  # eave before the wall, ridge behind it
ROWS, WAVE = 8, PANEL_M / 8
EAVE_Z = EAVE_M + 0.16
COVER_M, GUTTER_M = 0.070, -0.045  # heights of the tiles' crests and troughs


def roof_z(y):
    return EAVE_Z + (y + OVERHANG_M) * SLOPE


def tiles(part):
    """Covers and gutters, and their ends at the eave. The picture shows the courses."""
    middle = (COVER_M + GUTTER_M) / 2
    xs = [0.0] + [WAVE * (r + t) for r in range(ROWS) for t in (0.25, 0.75)] + [PANEL_M]
    heights = [middle] + ROWS * [COVER_M, GUTTER_M] + [middle]
    along = 1 / math.cos(math.radians(23.0))
    courses = [-OVERHANG_M, RIDGE_M]
    normals = [(0.0, -SLOPE, 1.0)] * len(xs)
    rows = [[(x, y, roof_z(y) + h) for x, h in zip(xs, heights)] for y in courses]
    part.strip("roof", rows, [(normals, normals)] * (len(rows) - 1), xs,
               [(y + OVERHANG_M) * along for y in courses])
    # The lower rim: the tiles' thickness, and the mortar that fills the covers' mouths.
    y = -OVERHANG_M
    rim = [(0.0, -1.0, 0.0)] * len(xs)
    lower = [(x, y, roof_z(y) + h - 0.03) for x, h in zip(xs, heights)]
    part.strip("roof", [lower, rows[0]], [(rim, rim)], xs, [0.30, 0.335])
    mouth = [(x, y + 0.05, roof_z(y) - 0.06) for x in xs]
    part.strip("soil", [mouth, lower], [(rim, rim)], xs, [0.0, 0.1])


def ridge(part):
    steps, radius, skirt = 4, 0.17, 0.14  # down into the gutters
    z = roof_z(RIDGE_M) + 0.03
    rows, normals = [], []
    for k in range(steps + 1):
        a = math.pi * k / steps
        n = (0.0, -math.cos(a), math.sin(a))
        drop = skirt if k in (0, steps) else 0.0
        rows.append([(x, RIDGE_M + radius * n[1], z + radius * n[2] - drop)
                     for x in (0.0, PANEL_M)])
        normals.append([n, n])
    part.strip("roof", rows, list(zip(normals, normals[1:])), [0.0, PANEL_M],
               [math.pi * radius * k / steps for k in range(steps + 1)])


def underside(part):
    """Boards on rafter tails."""
    y0 = -OVERHANG_M + 0.03
    part.polygon("wood", [(0, 0.1, roof_z(0.1) - 0.07), (PANEL_M, 0.1, roof_z(0.1) - 0.07),
                          (PANEL_M, y0, roof_z(y0) - 0.07), (0, y0, roof_z(y0) - 0.07)])
    for k in range(4):
        x, w = 0.25 + 0.5 * k, 0.05
        nose, wall = -0.47, 0.05
        top = [roof_z(y) - 0.075 for y in (nose, wall)]
        left = [(x - w, wall, top[1] - 0.16), (x - w, nose, top[0] - 0.09), (x - w, nose, top[0]),
                (x - w, wall, top[1])]
        right = [(x + w, y, z) for _, y, z in left]
        part.polygon("wood", left)
        part.polygon("wood", right[::-1])
        for i in range(2):
            part.polygon("wood", [left[i + 1], left[i], right[i], right[i + 1]][::-1])


def panel():
    """Uses the wing's frame: x along the eave, the face of the wall at y = 0."""
    part = Part("roof_panel")
    tiles(part)
    ridge(part)
    underside(part)
    return part


def verge(length_y=RIDGE_M):
    """The board and the row of tiles that close a gable, at x = 0, facing -x."""
    part = Part("roof_verge")
    y0, y1 = -OVERHANG_M, length_y
    part.polygon("wood", [(-0.16, y1, roof_z(y1) - 0.14), (-0.16, y0, roof_z(y0) - 0.14),
                          (-0.16, y0, roof_z(y0) + 0.05), (-0.16, y1, roof_z(y1) + 0.05)])
    part.polygon("wood", [(-0.16, y0, roof_z(y0) - 0.14), (0.0, y0, roof_z(y0) - 0.14),
                          (0.0, y0, roof_z(y0) + 0.05), (-0.16, y0, roof_z(y0) + 0.05)])
    part.polygon("wood", [(-0.16, y0, roof_z(y0) - 0.14), (-0.16, y1, roof_z(y1) - 0.14),
                          (0.02, y1, roof_z(y1) - 0.14), (0.02, y0, roof_z(y0) - 0.14)])
    part.polygon("roof", [(-0.18, y0, roof_z(y0) + 0.05), (0.04, y0, roof_z(y0) + 0.09),
                          (0.04, y1, roof_z(y1) + 0.09), (-0.18, y1, roof_z(y1) + 0.05)])
    return part


def back_wall(length):
    """The outer wall under the ridge. It is never seen, but it throws the wing's shadow."""
    part = Part(f"back_wall_{length:.0f}")
    z = roof_z(RIDGE_M)
    with part.density(0.15):
        part.polygon("plaster", [(length, RIDGE_M, 0), (0, RIDGE_M, 0), (0, RIDGE_M, z),
                                 (length, RIDGE_M, z)])
    return part
