"""Building blocks of the torture scene: quads, bars, boxes, turned shapes and leaf cards.

A Mesh has one surface per material. Lengths are metres; x is right, y is up, and the canal runs
along x. Faces wind counter-clockwise seen from outside.
"""
import contextlib
import math

import numpy as np


def unit(v):
    v = np.asarray(v, float)
    return v / max(np.linalg.norm(v), 1e-12)


def place(x=0.0, y=0.0, z=0.0, turn_deg=0.0, scale=1.0):
    """A 4x4 matrix that scales, turns about the upright axis, then moves."""
    c, s = math.cos(math.radians(turn_deg)) * scale, math.sin(math.radians(turn_deg)) * scale
    return np.array([[c, 0, s, x], [0, scale, 0, y], [-s, 0, c, z], [0, 0, 0, 1]], float)


class Surface:
    """All faces of a mesh with one material."""

    def __init__(self):
        self.positions, self.normals, self.uvs, self.colours = [], [], [], []
        self.triangles = []


class Mesh:

    def __init__(self, name):
        self.name = name
        self.surfaces = {}
        self.offset = np.zeros(3)

    @contextlib.contextmanager
    def at(self, x, y, z):
        """Moves the faces that are made within the block."""
        self.offset = self.offset + (x, y, z)
        yield
        self.offset = self.offset - (x, y, z)

    def face(self, material, points, normals, uvs=None, colours=None):
        """A convex polygon with a normal, a pair of coordinates and a colour for each corner."""
        surface = self.surfaces.setdefault(material, Surface())
        first = len(surface.positions)
        surface.positions += [tuple(np.asarray(p, float) + self.offset) for p in points]
        surface.normals += [tuple(unit(n)) for n in normals]
        surface.uvs += uvs or [(0.0, 0.0)] * len(points)
        surface.colours += colours or [(1.0, 1.0, 1.0)] * len(points)
        surface.triangles += [(first, first + i, first + i + 1)
                              for i in range(1, len(points) - 1)]

    def flat(self, material, points, uvs=None, colours=None):
        """A flat polygon. Without uvs, the picture lies upright on it, one metre per unit."""
        points = [np.asarray(p, float) for p in points]
        n = unit(np.cross(points[1] - points[0], points[2] - points[0]))
        if uvs is None:
            axis = int(np.argmax(np.abs(n)))
            flip = 1.0 if n[axis] > 0 else -1.0
            uvs = [((p[0], flip * p[2]) if axis == 1 else
                    (flip * p[0], -p[1]) if axis == 2 else (-flip * p[2], -p[1])) for p in points]
        self.face(material, points, [n] * len(points), uvs, colours)

    def box(self, material, low, high, skip="", shade=None):
        """skip: sides to leave out, of f(ront, +z) k (back) l(eft) r(ight) t(op) b(ottom).
        shade: brightness at the lower edge, which rises to 1 at the upper edge."""
        (x0, y0, z0), (x1, y1, z1) = low, high
        sides = {
            "f": [(x0, y0, z1), (x1, y0, z1), (x1, y1, z1), (x0, y1, z1)],
            "k": [(x1, y0, z0), (x0, y0, z0), (x0, y1, z0), (x1, y1, z0)],
            "l": [(x0, y0, z0), (x0, y0, z1), (x0, y1, z1), (x0, y1, z0)],
            "r": [(x1, y0, z1), (x1, y0, z0), (x1, y1, z0), (x1, y1, z1)],
            "t": [(x0, y1, z1), (x1, y1, z1), (x1, y1, z0), (x0, y1, z0)],
            "b": [(x0, y0, z0), (x1, y0, z0), (x1, y0, z1), (x0, y0, z1)]
        }
        dark = (shade if shade is not None else 1.0,) * 3
        for side, points in sides.items():
            if side not in skip:
                low_first = [dark, dark, (1.0,) * 3, (1.0,) * 3] if side in "fklr" else None
                self.flat(material, points, None, low_first)

    def bar(self, material, points, radius, sides=4, colour=(1.0, 1.0, 1.0), caps=False):
        """A round bar along a polyline, with normals that point away from its axis."""
        points = [np.asarray(p, float) for p in points]
        rings = []
        for i, p in enumerate(points):
            along = unit(points[min(i + 1, len(points) - 1)] - points[max(i - 1, 0)])
            across = unit(np.cross((0, 1, 0) if abs(along[1]) < 0.9 else (1, 0, 0), along))
            up = np.cross(along, across)
            out = [math.cos(a) * across + math.sin(a) * up
                   for a in (2 * math.pi * (k + 0.5) / sides for k in range(sides))]
            rings.append([(p + radius * o, o) for o in out])
        colours = [colour] * 4
        for a, b in zip(rings, rings[1:]):
            for k in range(sides):
                j = (k + 1) % sides
                corners = [a[k], a[j], b[j], b[k]]
                self.face(material, [c[0] for c in corners], [c[1] for c in corners], None, colours)
        if caps:
            self.flat(material, [c[0] for c in rings[0]][::-1], None, [colour] * sides)
            self.flat(material, [c[0] for c in rings[-1]], None, [colour] * sides)

    def lathe(self, material, profile, segments, colour=(1.0, 1.0, 1.0), tile=(1.0, 1.0)):
        """A turned shape about the upright axis. profile: (radius, height, normal's radius and
        height), upwards on the outside."""
        angles = [2 * math.pi * k / segments for k in range(segments + 1)]
        ring = [(math.sin(a), math.cos(a)) for a in angles]
        for (r0, y0, nr0, ny0), (r1, y1, nr1, ny1) in zip(profile, profile[1:]):
            for k in range(segments):
                (s0, c0), (s1, c1) = ring[k], ring[k + 1]
                points = [(r0 * s0, y0, r0 * c0), (r0 * s1, y0, r0 * c1), (r1 * s1, y1, r1 * c1),
                          (r1 * s0, y1, r1 * c0)]
                normals = [(nr0 * s0, ny0, nr0 * c0), (nr0 * s1, ny0, nr0 * c1),
                           (nr1 * s1, ny1, nr1 * c1), (nr1 * s0, ny1, nr1 * c0)]
                uvs = [(tile[0] * (k + i) / segments, -tile[1] * y)
                       for i, y in ((0, y0), (1, y0), (1, y1), (0, y1))]
                keep = [i for i in range(4) if not np.allclose(points[i], points[i - 1])]
                if len(keep) > 2:
                    self.face(material, [points[i] for i in keep], [normals[i] for i in keep],
                              [uvs[i] for i in keep], [colour] * len(keep))

    def card(self, material, centre, facing, spin, size, normal, colour):
        """A square card with a whole picture. `normal` lights it, whichever way it faces."""
        facing = unit(facing)
        right = unit(np.cross((0, 1, 0) if abs(facing[1]) < 0.95 else (1, 0, 0), facing))
        up = np.cross(facing, right)
        c, s = math.cos(spin) * size / 2, math.sin(spin) * size / 2
        right, up = right * c + up * s, up * c - right * s
        centre = np.asarray(centre, float)
        self.face(material,
                  [centre - right - up, centre + right - up, centre + right + up,
                   centre - right + up], [normal] * 4, [(0, 1), (1, 1), (1, 0), (0, 0)],
                  [colour] * 4)
