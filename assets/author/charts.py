"""Gives every chart its rectangle of the light map.

A chart of w x h texels has a rim of one texel, which only filtering reads.
"""
import numpy as np

from materials import MATERIALS

RIM = 1


class Mesh:
    """A part under one light. It is baked once, and all its placements share the result."""

    def __init__(self, name, light, part, matrices):
        self.name = f"{name}_{light}" if light else name
        self.part, self.matrices = part, matrices
        self.baked_at = matrices[len(matrices) // 2]
        self.light_uvs = {}  # material: n x 2, v downwards from the map's upper edge


def light_mapped(part):
    return [(name, s) for name, s in part.surfaces.items() if MATERIALS[name].lightmapped]


def chart_boxes(part):
    """{chart: (low, high)} in metres."""
    boxes = {}
    for _, surface in light_mapped(part):
        for chart, uv in zip(surface.charts, surface.chart_uvs):
            low, high = boxes.get(chart, (uv, uv))
            boxes[chart] = (np.minimum(low, uv), np.maximum(high, uv))
    return boxes


def pack(sizes, side):
    """Lower corners for rectangles in a square, or None if they do not fit. The largest go first,
    each into the free rectangle that it fills best, which is then cut in two."""
    free = np.array([[0, 0, side, side]])  # x, y, width, height
    places = np.zeros((len(sizes), 2), int)
    for i in sorted(range(len(sizes)), key=lambda i: (-sizes[i][1], -sizes[i][0])):
        w, h = sizes[i]
        slack = np.minimum(free[:, 2] - w, free[:, 3] - h)
        room = np.where(slack >= 0, slack, side + 1)
        if not (slack >= 0).any():
            return None
        best = int(np.argmin(room))
        x, y, width, height = free[best]
        places[i] = (x, y)
        if width - w < height - h:
            rest = [[x + w, y, width - w, h], [x, y + h, width, height - h]]
        else:
            rest = [[x + w, y, width - w, height], [x, y + h, w, height - h]]
        rest = [r for r in rest if r[2] > 2 * RIM and r[3] > 2 * RIM]
        free = np.concatenate([np.delete(free, best, 0), np.array(rest, int).reshape(-1, 4)])
    return places


def lay_out(scene, side):
    """The scene's meshes with coordinates in a light map of side x side texels, filled as densely
    as possible. Prints what came out."""
    meshes = [
        Mesh(name, light, part, matrices)
        for (name, light), (part, matrices) in scene.meshes().items()
    ]
    charts = []  # (mesh, chart, low, extent, density)
    for mesh in meshes:
        if mesh.part.light_of:
            continue
        for chart, (low, high) in sorted(chart_boxes(mesh.part).items()):
            charts.append((mesh, chart, low, high - low, mesh.part.chart_density[chart]))

    def sizes_at(texels_per_m):
        sizes = []
        for _, _, _, extent, density in charts:
            w, h = (max(1, round(float(e) * density * texels_per_m)) + 2 * RIM for e in extent)
            sizes.append((max(w, h), min(w, h)))
        return sizes

    low, high = 1.0, 64.0
    if pack(sizes_at(low), side) is None:
        raise ValueError(f"{len(charts)} charts do not fit into {side} x {side} texels")
    while high / low > 1.01:
        middle = (low + high) / 2
        if pack(sizes_at(middle), side) is None:
            high = middle
        else:
            low = middle
    # Packing is not quite monotonic: a slightly greater density may fit although this one does not.
    low = max(low * (1 + k / 400) for k in range(30)
              if pack(sizes_at(low * (1 + k / 400)), side) is not None)
    sizes, places = sizes_at(low), pack(sizes_at(low), side)
    used = sum(w * h for w, h in sizes) / side**2
    print(f"light map: {len(charts)} charts, {low:.1f} texels per metre, {used:.0%} used")
    rectangles = {}
    for (mesh, chart, origin, extent, _), size, place in zip(charts, sizes, places):
        rectangles[mesh.name, chart] = (origin, extent, size, place)
    for mesh in meshes:
        for material, surface in light_mapped(mesh.part):
            owner = mesh.part.light_of or mesh.name
            mesh.light_uvs[material] = (np.array([
                texel_of(uv, *rectangles[owner, chart])
                for chart, uv in zip(surface.charts, surface.chart_uvs)
            ]) / side)
    return meshes


def texel_of(uv, origin, extent, size, place):
    """Where a point of a chart lies in the map, in texels; long charts lie along x."""
    t = (np.asarray(uv) - origin) / np.maximum(extent, 1e-9)
    if extent[1] > extent[0]:
        t = np.array((1 - t[1], t[0]))
    return place + RIM + t * (np.asarray(size) - 2 * RIM)
