"""A wing of the arcade: five bays in front of a gallery, an upper floor and its cornices.

Local frame of a wing: x along the front (0..20 m), y into the building, z up; the court lies at
negative y. All three wings are this one part, turned.
"""
import math

import numpy as np

from geometry import Part

BAY_M, BAYS = 4.0, 5
LENGTH_M = BAY_M * BAYS
FLOOR_M = 0.15  # of the gallery
SPRING_M, ARCH_R, RING_M = 2.75, 1.50, 0.30  # foot of the arches, radius, depth of their rings
STRING_M, EAVE_M, CEILING_M = 5.0, 8.35, 4.7
WALL_M, GALLERY_M = 0.5, 3.6  # thickness of the front, depth of the gallery
WINDOW = (0.55, 5.75, 7.45)  # half width, sill, head
DOOR = (0.62, 2.45)  # half width, height
ARCH_STEPS = 20
TILTED = np.array([[1, 0, 0, 0], [0, 0, -1, 0], [0, 1, 0, 0], [0, 0, 0, 1]], float)  # z to -y


def centres():
    return [BAY_M * (b + 0.5) for b in range(BAYS)]


def spandrels(part, y, facing_court, material):
    """The wall above the arches, from the springing up, seen from one side."""
    outer = ARCH_R + RING_M if facing_court else ARCH_R
    top = STRING_M if facing_court else CEILING_M

    def wall(points):
        part.polygon(material, points if facing_court else points[::-1])

    with part.sheet("xz"):
        for c in centres():
            arc = [(c - outer * math.cos(math.pi * i / ARCH_STEPS), y,
                    SPRING_M + outer * math.sin(math.pi * i / ARCH_STEPS))
                   for i in range(ARCH_STEPS + 1)]
            for a, b in zip(arc, arc[1:]):
                wall([a, b, (b[0], y, top), (a[0], y, top)])
            for x0, x1 in ((c - BAY_M / 2, c - outer), (c + outer, c + BAY_M / 2)):
                wall([(x0, y, SPRING_M), (x1, y, SPRING_M), (x1, y, top), (x0, y, top)])


def arch_rings(part):
    """Moulded archivolts with keystones; their insides reach through the wall."""
    outer = ARCH_R + RING_M
    profile = [(ARCH_R, WALL_M), (ARCH_R, -0.04), (ARCH_R + 0.13, -0.04), (ARCH_R + 0.135, -0.065),
               (ARCH_R + 0.24, -0.065), (ARCH_R + 0.25, -0.10), (outer, -0.10), (outer, 0.0)]
    for c in centres():
        part.arch("carved", (c, SPRING_M), profile, ARCH_STEPS)
        top, foot = SPRING_M + outer + 0.12, SPRING_M + ARCH_R - 0.07
        low, high = 0.13, 0.20  # half widths of the keystone
        front = [(c - low, -0.16, foot), (c + low, -0.16, foot), (c + high, -0.16, top),
                 (c - high, -0.16, top)]
        back = [(x, 0.0, z) for x, _, z in front]
        part.polygon("carved", front)
        for i in range(4):
            j = (i + 1) % 4
            part.polygon("carved", [front[j], front[i], back[i], back[j]])


def upper_wall(part):
    half, sill, head = WINDOW
    with part.sheet("xz"):
        for c in centres():
            xs = [c - BAY_M / 2, c - half, c + half, c + BAY_M / 2]
            zs = [STRING_M, sill, head, EAVE_M + 0.42]
            for i in range(3):
                for k in range(3):
                    if (i, k) != (1, 1):
                        part.polygon("plaster", [(xs[i], 0, zs[k]), (xs[i + 1], 0, zs[k]),
                                                 (xs[i + 1], 0, zs[k + 1]), (xs[i], 0, zs[k + 1])])


def gallery(part):
    half, height = DOOR
    with part.sheet("xz", 0.8):
        for c in centres():
            xs = [c - BAY_M / 2, c - half, c + half, c + BAY_M / 2]
            zs = [FLOOR_M, FLOOR_M + height, CEILING_M]
            for i in range(3):
                for k in range(2):
                    if (i, k) != (1, 0):
                        part.polygon("plaster", [(xs[i], GALLERY_M, zs[k]),
                                                 (xs[i + 1], GALLERY_M, zs[k]),
                                                 (xs[i + 1], GALLERY_M, zs[k + 1]),
                                                 (xs[i], GALLERY_M, zs[k + 1])])
    with part.density(1.0):
        part.polygon("wood", [(0, GALLERY_M, CEILING_M), (LENGTH_M, GALLERY_M, CEILING_M),
                              (LENGTH_M, WALL_M, CEILING_M), (0, WALL_M, CEILING_M)])
    with part.sheet("xy"):
        for c in centres():
            x0, x1 = c - BAY_M / 2, c + BAY_M / 2
            part.polygon("paving", [(x0, -0.35, FLOOR_M), (x1, -0.35, FLOOR_M),
                                    (x1, GALLERY_M, FLOOR_M), (x0, GALLERY_M, FLOOR_M)])
    # Seen through the joints of floor and walls, whose edges are cut at different places.
    y, z = GALLERY_M, FLOOR_M - 0.02
    for x0, x1, y0, y1 in ((-0.6, LENGTH_M + 0.6, y - 0.05, y + 0.6), (-0.6, 0.05, 0.1, y),
                           (LENGTH_M - 0.05, LENGTH_M + 0.6, 0.1, y)):
        part.polygon("joint", [(x0, y0, z), (x1, y0, z), (x1, y1, z), (x0, y1, z)])
    for x in (0.0, LENGTH_M):
        x0, x1, behind = x - 0.1, x + 0.1, y + 0.03
        part.polygon("joint", [(x0, behind, z), (x1, behind, z), (x1, behind, CEILING_M),
                               (x0, behind, CEILING_M)])
    part.moulding("carved", 0, LENGTH_M, [(-0.35, 0.0), (-0.35, 0.09), (-0.37, 0.10),
                                          (-0.37, FLOOR_M), (-0.30, FLOOR_M + 0.001)])


def cornices(part):
    part.moulding("carved", 0, LENGTH_M, [(0, 4.84), (-0.05, 4.86), (-0.05, 4.93), (-0.08, 4.95),
                                          (-0.14, 5.01), (-0.14, 5.08), (-0.10, 5.12), (0, 5.16)])
    part.moulding("carved", 0, LENGTH_M, [(0, 7.90), (-0.04, 7.93), (-0.04, 8.02), (-0.08, 8.05),
                                          (-0.16, 8.14), (-0.20, 8.22), (-0.20, 8.34), (0, 8.37)])


def wing():
    part = Part("wing")
    spandrels(part, 0.0, True, "ashlar")
    spandrels(part, WALL_M, False, "plaster")
    arch_rings(part)
    upper_wall(part)
    gallery(part)
    cornices(part)
    return part


def medallion():
    """A turned boss on the wall between two arches; its axis is -y, its middle the origin."""
    part = Part("medallion")
    with part.placed(matrix=TILTED):
        part.lathe("carved", [(0.34, 0.0), (0.34, 0.05), (0.31, 0.075), (0.26, 0.075),
                              (0.24, 0.045), (0.17, 0.045), (0.15, 0.08), (0.0, 0.11)], 14)
    return part


def beams():
    """Four ceiling beams of one bay."""
    part = Part("beams")
    for k in range(4):
        x = 0.5 + k
        part.box("wood", (x - 0.09, WALL_M, CEILING_M - 0.22), (x + 0.09, GALLERY_M, CEILING_M),
                 "fbt")
    return part


def corner():
    """Where two galleries meet behind the court's corner: floor, ceiling, outer walls. The corner
    itself is the origin, the galleries lie at +x and +y."""
    part = Part("corner")
    g = GALLERY_M
    with part.density(0.8):
        part.polygon("paving", [(0, 0, FLOOR_M), (g, 0, FLOOR_M), (g, g, FLOOR_M), (0, g, FLOOR_M)])
        part.polygon("wood", [(0, g, CEILING_M), (g, g, CEILING_M), (g, 0, CEILING_M),
                              (0, 0, CEILING_M)])
        z, end = FLOOR_M - 0.02, g + 0.6
        part.polygon("joint", [(0.1, 0.1, z), (end, 0.1, z), (end, end, z), (0.1, end, z)])
        for a, b in (((0, g), (g, g)), ((g, g), (g, 0))):
            part.polygon("plaster", [(*a, FLOOR_M), (*b, FLOOR_M), (*b, CEILING_M),
                                     (*a, CEILING_M)])
    return part


def corner_pier():
    """Carries the last arches of both wings; with clasping pilasters towards the court."""
    part = Part("corner_pier")
    part.box("ashlar", (-0.04, -0.04, 0), (0.5, 0.5, SPRING_M), "dt")
    part.box("carved", (-0.45, -0.10, 0), (0.55, 0.5, FLOOR_M + 0.16), "d")
    part.box("carved", (-0.10, -0.45, 0), (0.5, -0.10, FLOOR_M + 0.16), "d")
    part.box("ashlar", (-0.38, -0.06, FLOOR_M + 0.16), (-0.04, 0.46, 2.55), "dtr")
    part.box("ashlar", (-0.06, -0.38, FLOOR_M + 0.16), (0.46, -0.04, 2.55), "dtb")
    part.box("carved", (-0.48, -0.12, 2.55), (0.55, 0.55, SPRING_M), "")
    part.box("carved", (-0.12, -0.48, 2.55), (0.55, -0.12, SPRING_M), "b")
    return part


def gable(slope, ridge_y):
    """A wing's south end: the wall under the roof, from y = 0 to the ridge, at x = 0, facing -x."""
    part = Part("gable")
    with part.sheet("yz", 0.6):
        part.polygon("plaster", [(0, ridge_y, 0), (0, 0.6, 0), (0, 0.6, EAVE_M - 0.1 + 0.6 * slope),
                                 (0, ridge_y, EAVE_M - 0.1 + ridge_y * slope)])
    part.box("ashlar", (-0.12, -0.12, 0), (0.42, 0.62, STRING_M - 0.1), "d")
    part.polygon("plaster", [(0, 0.6, STRING_M - 0.1), (0, 0, STRING_M - 0.1), (0, 0, EAVE_M),
                             (0, 0.6, EAVE_M + 0.2)])
    for k in range(6):  # quoins
        deep = 0.5 if k % 2 else 0.34
        z = STRING_M + 0.22 + k * 0.45
        part.box("carved", (-0.05, -0.05, z), (0.84 - deep, deep, z + 0.41), "")
    return part
