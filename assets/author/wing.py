"""A wing of the arcade: five bays in front of a gallery, an upper floor and its cornices.

Local frame of a wing: x along the front (0..20 m), y into the building, z up; the court lies at
negative y. All three wings are this one part, turned.
"""
import math

import numpy as np

from geometry import Part

BAY_M, BAYS = 4.0, 5
LENGTH_M = BAY_M * BAYS
FLOOR_M = 0.15  # height of the gallery's floor
SPRING_M, ARCH_R, RING_M = 2.75, 1.50, 0.30  # foot of the arches, radius, depth of their rings
STRING_M, EAVE_M, CEILING_M = 5.0, 8.35, 4.7
WALL_M, GALLERY_M = 0.5, 3.6  # thickness of the front, depth of the gallery
WINDOW = (0.55, 5.75, 7.45)  # half width, sill, head
DOOR = (0.62, 2.45)  # half width, height
ARCH_STEPS = {"near": 14, "far": 10}  # segments, by how near the paths come
TILTED = np.array([[1, 0, 0, 0], [0, 0, -1, 0], [0, 1, 0, 0], [0, 0, 0, 1]], float)  # z to -y


def centres():
    return [BAY_M * (b + 0.5) for b in range(BAYS)]


def spandrels(part):
    """The wall above the arches towards the court, from the springing up. Its holes are half a
    hexagon each, whose edge the arch's ring hides."""
    corner = ARCH_R + RING_M - 0.02
    foot, haunch = SPRING_M, SPRING_M + corner * math.sin(math.pi / 3)
    top = STRING_M + 0.06  # behind the cornice, which also hides where the plaster begins
    with part.sheet("xz"):
        for c in centres():
            x0, x1 = c - corner / 2, c + corner / 2
            part.polygon("ashlar_far", [(x0, 0, haunch), (x1, 0, haunch), (x1, 0, top),
                                        (x0, 0, top)])
        for x in [BAY_M * b for b in range(BAYS + 1)]:
            outline = [(x + BAY_M / 2 - corner / 2, 0, top), (x - BAY_M / 2 + corner / 2, 0, top),
                       (x - BAY_M / 2 + corner / 2, 0, haunch), (x - BAY_M / 2 + corner, 0, foot),
                       (x + BAY_M / 2 - corner, 0, foot), (x + BAY_M / 2 - corner / 2, 0, haunch)]
            if x == 0.0:
                outline = [outline[5], outline[0], (0, 0, top), (0, 0, foot), outline[4]]
            elif x == LENGTH_M:
                outline = [(x, 0, top), *outline[1:4], (x, 0, foot)]
            part.polygon("ashlar_far", outline)


def spandrels_inside(part, steps):
    """The same wall seen from the gallery."""
    y, top = WALL_M, CEILING_M
    with part.sheet("xz"):
        for c in centres():
            arc = [(c - ARCH_R * math.cos(math.pi * i / steps), y,
                    SPRING_M + ARCH_R * math.sin(math.pi * i / steps)) for i in range(steps + 1)]
            for a, b in zip(arc, arc[1:]):
                part.polygon("plaster", [(a[0], y, top), (b[0], y, top), b, a])
            for x0, x1 in ((c - BAY_M / 2, c - ARCH_R), (c + ARCH_R, c + BAY_M / 2)):
                part.polygon("plaster", [(x0, y, top), (x1, y, top), (x1, y, SPRING_M),
                                         (x0, y, SPRING_M)])


def arch_rings(part, seen):
    """Moulded archivolts with keystones; their insides reach through the wall."""
    outer = ARCH_R + RING_M
    profile = [(ARCH_R, WALL_M), (ARCH_R, -0.05), (ARCH_R + 0.20, -0.05), (outer, -0.10),
               (outer, 0.0)]
    if seen == "near":
        profile.insert(3, (ARCH_R + 0.22, -0.10))
    for c in centres():
        part.arch("carved", (c, SPRING_M), profile, ARCH_STEPS[seen])
        top, foot = SPRING_M + outer + 0.12, SPRING_M + ARCH_R - 0.07
        low, high = 0.13, 0.20  # half widths of the keystone
        front = [(c - low, -0.16, foot), (c + low, -0.16, foot), (c + high, -0.16, top),
                 (c - high, -0.16, top)]
        back = [(x, 0.0, z) for x, _, z in front]
        part.polygon("carved", front)
        for i in range(4):
            j = (i + 1) % 4
            part.polygon("carved", [front[j], front[i], back[i], back[j]])


def pierced_wall(part, y, half, foot, top, infills):
    """Plaster with a hole in each bay, half its width from the bay's middle. infills: (foot, top)
    of what there is of wall over and under the hole; it lies a hair further back and reaches behind
    its neighbours, whose edges are longer than its own. These come last: they share the infills'
    chart, and where both lie the last one is baked."""
    behind, lap = y + 0.004, 0.15
    for c in centres():
        x0, x1 = c - half - lap, c + half + lap
        for z0, z1 in infills:
            part.polygon("plaster", [(x0, behind, z0), (x1, behind, z0), (x1, behind, z1),
                                     (x0, behind, z1)])
    sides = [0.0] + [c + d for c in centres() for d in (-half, half)] + [LENGTH_M]
    for x0, x1 in zip(sides[0::2], sides[1::2]):
        part.polygon("plaster", [(x0, y, foot), (x1, y, foot), (x1, y, top), (x0, y, top)])


def upper_wall(part):
    half, sill, head = WINDOW
    with part.sheet("xz"):
        pierced_wall(part, 0, half, STRING_M, EAVE_M + 0.42, ((STRING_M, sill),
                                                              (head, EAVE_M + 0.42)))


def gallery(part):
    half, height = DOOR
    with part.sheet("xz", 0.8):
        pierced_wall(part, GALLERY_M, half, FLOOR_M, CEILING_M, ((FLOOR_M + height, CEILING_M), ))
    with part.density(1.0):
        behind = GALLERY_M + 0.05
        part.polygon("wood", [(0, behind, CEILING_M), (LENGTH_M, behind, CEILING_M),
                              (LENGTH_M, WALL_M, CEILING_M), (0, WALL_M, CEILING_M)])
    with part.sheet("xy"):
        for c in centres():
            x0, x1 = c - BAY_M / 2, c + BAY_M / 2
            part.polygon("paving", [(x0, -0.35, FLOOR_M), (x1, -0.35, FLOOR_M),
                                    (x1, GALLERY_M, FLOOR_M), (x0, GALLERY_M, FLOOR_M)])
    # Fills the joints of floor and walls, whose edges have vertices at different positions.
    y, z = GALLERY_M, FLOOR_M - 0.02
    for x0, x1, y0, y1 in ((-0.6, LENGTH_M + 0.6, y - 0.05, y + 0.6), (-0.6, 0.05, 0.1, y),
                           (LENGTH_M - 0.05, LENGTH_M + 0.6, 0.1, y)):
        part.polygon("joint", [(x0, y0, z), (x1, y0, z), (x1, y1, z), (x0, y1, z)])
    for x in (0.0, LENGTH_M):
        x0, x1, behind = x - 0.1, x + 0.1, y + 0.03
        part.polygon("joint", [(x0, behind, z), (x1, behind, z), (x1, behind, CEILING_M),
                               (x0, behind, CEILING_M)])
    part.moulding("carved", 0, LENGTH_M, [(-0.37, 0.0), (-0.37, FLOOR_M + 0.001),
                                          (-0.30, FLOOR_M + 0.001)])


def cornices(part):
    """Has no upper sides, because it is only seen from below."""
    part.moulding("carved", 0, LENGTH_M, [(0, 4.84), (-0.14, 4.98), (-0.14, 5.10)])
    part.moulding("carved", 0, LENGTH_M, [(0, 7.90), (-0.05, 8.01), (-0.20, 8.20),
                                          (-0.20, 8.35)])


def wing(seen):
    """seen: "near" or "far"."""
    part = Part(f"wing_{seen}")
    spandrels(part)
    spandrels_inside(part, ARCH_STEPS[seen])
    arch_rings(part, seen)
    upper_wall(part)
    gallery(part)
    cornices(part)
    return part


def medallion():
    """A turned boss on the wall between two arches; its axis is -y, its middle the origin."""
    part = Part("medallion")
    with part.placed(matrix=TILTED):
        part.lathe("carved", [(0.34, 0.0), (0.325, 0.07), (0.25, 0.07), (0.22, 0.04),
                              (0.0, 0.11)], 10)
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
    """The corner pier under the last arches of both wings, with pilasters to the court."""
    part = Part("corner_pier")
    part.box("ashlar_far", (-0.04, -0.04, 0), (0.5, 0.5, SPRING_M), "dt")
    part.box("carved", (-0.45, -0.10, 0), (0.55, 0.5, FLOOR_M + 0.16), "d")
    part.box("carved", (-0.10, -0.45, 0), (0.5, -0.10, FLOOR_M + 0.16), "d")
    part.box("ashlar_far", (-0.38, -0.06, FLOOR_M + 0.16), (-0.04, 0.46, 2.55), "dtr")
    part.box("ashlar_far", (-0.06, -0.38, FLOOR_M + 0.16), (0.46, -0.04, 2.55), "dtb")
    part.box("carved", (-0.48, -0.12, 2.55), (0.55, 0.55, SPRING_M), "")
    part.box("carved", (-0.12, -0.48, 2.55), (0.55, -0.12, SPRING_M), "b")
    return part


def gable(slope, ridge_y):
    """A wing's south end: the wall under the roof, from y = 0 to the ridge, at x = 0, facing -x."""
    part = Part("gable")
    with part.sheet("yz", 0.6):
        part.polygon("plaster", [(0, ridge_y, 0), (0, 0.6, 0), (0, 0.6, EAVE_M - 0.1 + 0.6 * slope),
                                 (0, ridge_y, EAVE_M - 0.1 + ridge_y * slope)])
    part.box("ashlar_far", (-0.12, -0.12, 0), (0.42, 0.62, STRING_M - 0.1), "d")
    part.polygon("plaster", [(0, 0.6, STRING_M - 0.1), (0, 0, STRING_M - 0.1), (0, 0, EAVE_M),
                             (0, 0.6, EAVE_M + 0.2)])
    for k in range(6):  # quoins
        deep = 0.5 if k % 2 else 0.34
        z = STRING_M + 0.22 + k * 0.45
        part.box("carved", (-0.05, -0.05, z), (0.84 - deep, deep, z + 0.41), "")
    return part
