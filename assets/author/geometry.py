"""Building blocks of meshes: boxes, polygons, mouldings, turned shapes, leaf cards.

A Part is modelled once, in metres with z up, and placed any number of times (Scene). Its corners
carry position, normal, texture coordinates in metres, and coordinates in metres within a *chart*:
a piece of surface that gets a rectangle of the light map of its own. Faces wind counter-clockwise
seen from outside.
"""
import contextlib
import math

import numpy as np

from materials import MATERIALS

SMOOTH_DEG = 38.0  # a profile that bends by less is shaded as a curve


def frame(x=0.0, y=0.0, z=0.0, turn_deg=0.0, scale=1.0):
    """A 4x4 matrix that scales, turns about z, then moves."""
    c, s = math.cos(math.radians(turn_deg)), math.sin(math.radians(turn_deg))
    c, s = (round(v) if abs(v - round(v)) < 1e-12 else v for v in (c, s))
    return np.array([[c * scale, -s * scale, 0, x], [s * scale, c * scale, 0, y], [0, 0, scale, z],
                     [0, 0, 0, 1]], float)


def unit(v):
    v = np.asarray(v, float)
    return v / max(np.linalg.norm(v), 1e-12)


def plane_uv(p, n):
    """Upright texture coordinates of a point on a surface that faces n; never mirrored."""
    axis = int(np.argmax(np.abs(n)))
    if axis == 2:
        return (p[0], p[1] if n[2] > 0 else -p[1])
    if axis == 1:
        return (p[0] if n[1] < 0 else -p[0], p[2])
    return (p[1] if n[0] > 0 else -p[1], p[2])


def profile_normals(profile, smooth_deg=SMOOTH_DEG):
    """For each segment of a polyline the 2D normals (to its right) at both ends, round where it
    bends by less than smooth_deg; and for each segment the number of the run between two edges it
    belongs to."""
    segments = np.diff(np.asarray(profile, float), axis=0)
    normals = [unit((d[1], -d[0])) for d in segments]
    ends, runs, run = [[n, n] for n in normals], [0], 0
    for i in range(1, len(normals)):
        if np.dot(normals[i - 1], normals[i]) > math.cos(math.radians(smooth_deg)):
            ends[i - 1][1] = ends[i][0] = unit(normals[i - 1] + normals[i])
        else:
            run += 1
        runs.append(run)
    return ends, runs


class Surface:
    """All faces of a part with one material."""

    def __init__(self):
        self.positions, self.normals, self.uvs, self.colours = [], [], [], []
        self.charts, self.chart_uvs = [], []
        self.triangles = []


class Part:

    def __init__(self, name, light_of=None):
        """light_of: the name of the part in whose charts this part's surfaces lie (lit_as)."""
        self.name = name
        self.light_of = light_of
        self.surfaces = {}
        self.chart_density = []  # per chart; texels per metre, relative
        self._frame = np.eye(4)
        self._sheet = None
        self._density = 1.0
        self._spot = None

    # ---- state that applies to the next faces

    @contextlib.contextmanager
    def placed(self, x=0.0, y=0.0, z=0.0, turn_deg=0.0, matrix=None):
        """Moves the faces that are made within the block."""
        before = self._frame
        self._frame = before @ (frame(x, y, z, turn_deg) if matrix is None else matrix)
        yield
        self._frame = before

    @contextlib.contextmanager
    def sheet(self, axes, density=1.0):
        """Faces made within the block share a chart, laid out by two coordinates ('xz')."""
        self._sheet = (["xyz".index(a) for a in axes], self.chart(density))
        yield
        self._sheet = None

    @contextlib.contextmanager
    def lit_as(self, spot):
        """Faces made within the block have the light of another part: spot(point) returns the
        chart of that part and the coordinates in it."""
        self._spot = spot
        yield
        self._spot = None

    @contextlib.contextmanager
    def density(self, factor):
        before, self._density = self._density, self._density * factor
        yield
        self._density = before

    def chart(self, density):
        """Number of a new chart."""
        self.chart_density.append(density * self._density)
        return len(self.chart_density) - 1

    # ---- faces

    def face(self, material, points, normals, uvs, chart, chart_uvs, colour=(1.0, 1.0, 1.0)):
        """A convex polygon."""
        surface = self.surfaces.setdefault(material, Surface())
        first = len(surface.positions)
        spots = [(chart, uv) for uv in chart_uvs]
        if self._spot:
            spots = [self._spot(p) for p in points]
        for p, n, uv, (chart, chart_uv) in zip(points, normals, uvs, spots):
            surface.positions.append(
                tuple(self._frame[:3, :3] @ np.asarray(p, float) + self._frame[:3, 3]))
            surface.normals.append(tuple(unit(self._frame[:3, :3] @ np.asarray(n, float))))
            surface.uvs.append(uv)
            surface.colours.append(colour)
            surface.charts.append(chart)
            surface.chart_uvs.append(chart_uv)
        for i in range(1, len(points) - 1):
            surface.triangles.append((first, first + i, first + i + 1))

    def polygon(self, material, points, uvs=None):
        points = [np.asarray(p, float) for p in points]
        n = unit(sum(
            np.cross(points[i], points[(i + 1) % len(points)]) for i in range(len(points))))
        if uvs is None:
            uvs = [plane_uv(p, n) for p in points]
        if self._sheet:
            axes, chart = self._sheet
            chart_uvs = [tuple(p[axes]) for p in points]
        else:
            chart = self.chart(MATERIALS[material].density)
            right = unit(points[1] - points[0])
            up = np.cross(n, right)
            chart_uvs = [(np.dot(p - points[0], right), np.dot(p - points[0], up)) for p in points]
        self.face(material, points, [n] * len(points), uvs, chart, chart_uvs)

    def box(self, material, low, high, skip="", uv_fit=False):
        """skip: sides to leave out, of f(ront, -y) b(ack) l(eft, -x) r(ight) t(op) d(own).
        uv_fit: the picture fills the front and the back once instead of tiling."""
        (x0, y0, z0), (x1, y1, z1) = low, high
        width, height = MATERIALS[material].tile_m
        fit = [(0, 0), (width, 0), (width, height), (0, height)] if uv_fit else None
        sides = {
            "f": [(x0, y0, z0), (x1, y0, z0), (x1, y0, z1), (x0, y0, z1)], "b": [(x1, y1, z0),
                                                                                 (x0, y1, z0),
                                                                                 (x0, y1, z1),
                                                                                 (x1, y1, z1)],
            "l": [(x0, y1, z0), (x0, y0, z0), (x0, y0, z1), (x0, y1, z1)], "r": [(x1, y0, z0),
                                                                                 (x1, y1, z0),
                                                                                 (x1, y1, z1),
                                                                                 (x1, y0, z1)],
            "t": [(x0, y0, z1), (x1, y0, z1), (x1, y1, z1), (x0, y1, z1)], "d": [(x0, y1, z0),
                                                                                 (x1, y1, z0),
                                                                                 (x1, y0, z0),
                                                                                 (x0, y0, z0)]
        }
        for side, points in sides.items():
            if side not in skip:
                self.polygon(material, points, fit if side in "fb" else None)

    def strip(self, material, rows, normal_rows, us, vs, us_rows=None):
        """A bent sheet. rows: points from the lower to the upper edge, each from left to right;
        normal_rows: per band of rows the normals at its lower and upper edge; us, vs: metres along
        columns and rows; us_rows: per band its own us for the picture."""
        chart = self.chart(MATERIALS[material].density)
        for i in range(len(rows) - 1):
            low, high = normal_rows[i]
            picture_us = us_rows[i] if us_rows else us
            for j in range(len(us) - 1):
                points = [rows[i][j], rows[i][j + 1], rows[i + 1][j + 1], rows[i + 1][j]]
                normals = [low[j], low[j + 1], high[j + 1], high[j]]
                at = [(j, i), (j + 1, i), (j + 1, i + 1), (j, i + 1)]
                keep = [k for k in range(4) if not np.allclose(points[k], points[k - 1], atol=1e-7)]
                if len(keep) < 3:
                    continue
                self.face(material, [points[k] for k in keep], [normals[k] for k in keep],
                          [(picture_us[at[k][0]], vs[at[k][1]]) for k in keep], chart,
                          [(us[at[k][0]], vs[at[k][1]]) for k in keep])

    def lathe(self, material, profile, segments, start_deg=0.0, flat=False, smooth_deg=SMOOTH_DEG):
        """A turned shape about z. profile: (radius, z) upwards on the outside. flat: facets."""
        ends, runs = profile_normals(profile, smooth_deg)
        angles = [math.radians(start_deg + 360.0 * k / segments) for k in range(segments + 1)]
        ring = [(math.cos(a), math.sin(a)) for a in angles]
        rows = [[(r * c, r * s, z) for c, s in ring] for r, z in profile]
        vs = np.concatenate([[0], np.cumsum(np.hypot(*np.diff(np.asarray(profile), axis=0).T))])
        around = 2 * math.pi * max(r for r, _ in profile)
        us = [around * k / segments for k in range(segments + 1)]
        us_rows = [[length * k / segments for k in range(segments + 1)]
                   for length in self._lengths_around(material, profile, runs)]
        if not flat:
            normal_rows = [[[(n[0] * c, n[0] * s, n[1]) for c, s in ring] for n in pair]
                           for pair in ends]
            self.strip(material, rows, normal_rows, us, vs, us_rows)
            return
        for k in range(segments):
            middle = (angles[k] + angles[k + 1]) / 2
            c, s = math.cos(middle), math.sin(middle)
            normal_rows = [[[(n[0] * c, n[0] * s, n[1])] * 2 for n in pair] for pair in ends]
            self.strip(material, [row[k:k + 2] for row in rows], normal_rows, us[k:k + 2], vs,
                       [row[k:k + 2] for row in us_rows])

    @staticmethod
    def _lengths_around(material, profile, runs):
        """For each band how long the picture is laid around it: whole pictures, and of one length
        for all bands between two edges, so that the picture is not sheared."""
        tile = MATERIALS[material].tile_m[0]
        for run in runs:
            radii = [profile[k][0] for j, r in enumerate(runs) if r == run for k in (j, j + 1)]
            yield max(1, round(2 * math.pi * sum(radii) / len(radii) / tile)) * tile

    def disc(self, material, radius, z, segments, start_deg=0.0):
        self.polygon(material, [(radius * math.cos(a), radius * math.sin(a), z)
                                for a in (math.radians(start_deg) + 2 * math.pi * k / segments
                                          for k in range(segments))])

    def moulding(self, material, x0, x1, profile, caps=False):
        """A profile of (y, z), upwards, drawn along x; its outside is towards -y."""
        ends, _ = profile_normals([(-y, z) for y, z in profile])
        vs = np.concatenate([[0], np.cumsum(np.hypot(*np.diff(np.asarray(profile), axis=0).T))])
        normal_rows = [[[(0, -n[0], n[1])] * 2 for n in pair] for pair in ends]
        self.strip(material, [[(x0, y, z), (x1, y, z)] for y, z in profile], normal_rows, [x0, x1],
                   vs)
        if caps:
            back = max(y for y, _ in profile)
            outline = profile + [(back, profile[-1][1]), (back, profile[0][1])]
            for x, order in ((x0, outline[::-1]), (x1, outline)):
                for (ya, za), (yb, zb) in zip(profile, profile[1:]):
                    quad = [(x, ya, za), (x, back, za), (x, back, zb), (x, yb, zb)]
                    quad = [p for k, p in enumerate(quad) if not np.allclose(p, quad[k - 1])]
                    if len(quad) > 2:
                        self.polygon(material, quad if x == x1 else quad[::-1])

    def arch(self, material, centre, profile, segments, from_deg=180.0, to_deg=0.0):
        """A profile of (radius, y) drawn along an arch in the xz plane about centre (x, z). From
        the left foot to the right; a profile of growing radius faces -y."""
        ends, _ = profile_normals([(r, y) for r, y in profile])
        angles = [
            math.radians(from_deg + (to_deg - from_deg) * k / segments) for k in range(segments + 1)
        ]
        ring = [(math.cos(a), math.sin(a)) for a in angles]
        rows = [[(centre[0] + r * c, y, centre[1] + r * s) for c, s in ring] for r, y in profile]
        normal_rows = [[[(n[0] * c, n[1], n[0] * s) for c, s in ring] for n in pair]
                       for pair in ends]
        vs = np.concatenate([[0], np.cumsum(np.hypot(*np.diff(np.asarray(profile), axis=0).T))])
        radius = sum(r for r, _ in profile) / len(profile)
        us = [abs(a - angles[0]) * radius for a in angles]
        self.strip(material, rows, normal_rows, us, vs)

    def card(self, material, centre, facing, spin, size, normal, colour):
        """A square card with a picture. `normal` lights it, whichever way it faces."""
        facing = unit(facing)
        right = unit(np.cross((0.0, 0.0, 1.0) if abs(facing[2]) < 0.95 else (1.0, 0.0, 0.0),
                              facing))
        up = np.cross(facing, right)
        c, s = math.cos(spin) * size / 2, math.sin(spin) * size / 2
        right, up = right * c + up * s, up * c - right * s
        centre = np.asarray(centre, float)
        width, height = MATERIALS[material].tile_m
        self.face(
            material,
            [centre - right - up, centre + right - up, centre + right + up, centre - right + up],
            [normal] * 4, [(0, 0), (width, 0), (width, height),
                           (0, height)], -1, [(0, 0)] * 4, colour)


def mirrored(part):
    """The part with left and right exchanged. Its pictures are not mirrored."""
    other = Part(part.name + "_mirrored")
    other.chart_density = list(part.chart_density)
    for material, surface in part.surfaces.items():
        copy = other.surfaces[material] = Surface()
        copy.positions = [(-x, y, z) for x, y, z in surface.positions]
        copy.normals = [(-x, y, z) for x, y, z in surface.normals]
        copy.uvs = [(-u, v) for u, v in surface.uvs]
        copy.colours, copy.charts = surface.colours, surface.charts
        copy.chart_uvs = surface.chart_uvs
        copy.triangles = [(a, c, b) for a, b, c in surface.triangles]
    return other


class Scene:
    """Parts and their positions.

    Placements of a part that receive the same light (`light`) share a mesh and its rectangles of
    the light map, which are baked at the middle one in order."""

    def __init__(self):
        self.placements = []  # (part, matrix, light)

    def add(self, part, x=0.0, y=0.0, z=0.0, turn_deg=0.0, light="", scale=1.0, within=None):
        matrix = frame(x, y, z, turn_deg, scale)
        self.placements.append((part, matrix if within is None else within @ matrix, light))

    def meshes(self):
        """{(part's name, light): (part, [matrices])} in order of first use."""
        found = {}
        for part, matrix, light in self.placements:
            found.setdefault((part.name, light), (part, []))[1].append(matrix)
        return found
