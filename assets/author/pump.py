"""Makes a steam pump as glTF: node animation with all interpolations, morph targets and a skin.

glTF has y up. The animation "run" lasts 2 s and repeats without a jump.
"""
import json
import math
import struct

import numpy as np

FLOAT, UINT16, UINT8 = 5126, 5123, 5121
DURATION = 2.0


class Glb:

    def __init__(self):
        self.bytes = bytearray()
        self.json = {"asset": {"version": "2.0", "generator": "Diptych assets/author"}, "scene": 0,
                     "scenes": [{"name": "pump", "nodes": []}], "nodes": [], "meshes": [],
                     "materials": [], "accessors": [], "bufferViews": [], "skins": [],
                     "animations": [{"name": "run", "samplers": [], "channels": []}]}

    def accessor(self, array, component, shape, bounds=False):
        self.bytes += bytes(-len(self.bytes) % 4)
        data = np.ascontiguousarray(array).tobytes()
        self.json["bufferViews"].append({"buffer": 0, "byteOffset": len(self.bytes),
                                         "byteLength": len(data)})
        self.bytes += data
        entry = {"bufferView": len(self.json["bufferViews"]) - 1, "componentType": component,
                 "count": len(array), "type": shape}
        if bounds:
            low, high = np.min(array, 0), np.max(array, 0)
            entry["min"] = np.atleast_1d(low).tolist()
            entry["max"] = np.atleast_1d(high).tolist()
        self.json["accessors"].append(entry)
        return len(self.json["accessors"]) - 1

    def vectors(self, array, bounds=False):
        return self.accessor(np.asarray(array, "<f4"), FLOAT, "VEC3", bounds)

    def add(self, kind, value):
        self.json[kind].append(value)
        return len(self.json[kind]) - 1

    def material(self, name, colour, roughness=0.6):
        return self.add("materials", {"name": name, "pbrMetallicRoughness": {
            "baseColorFactor": [*colour, 1], "metallicFactor": 0, "roughnessFactor": roughness}})

    def mesh(self, name, material, shape, targets=(), joints=None, weights=None, rest=None):
        positions, normals, triangles = shape
        attributes = {"POSITION": self.vectors(positions, True), "NORMAL": self.vectors(normals)}
        if joints is not None:
            attributes["JOINTS_0"] = self.accessor(joints.astype(np.uint8), UINT8, "VEC4")
            attributes["WEIGHTS_0"] = self.accessor(weights.astype("<f4"), FLOAT, "VEC4")
        primitive = {"attributes": attributes, "material": material, "indices": self.accessor(
            np.asarray(triangles, "<u2").ravel(), UINT16, "SCALAR")}
        if targets:
            primitive["targets"] = [
                {"POSITION": self.vectors(p - positions, True), "NORMAL": self.vectors(n - normals)}
                for p, n, _ in targets]
        value = {"name": name, "primitives": [primitive]}
        if rest:
            value["weights"] = rest
        return self.add("meshes", value)

    def node(self, name, parent=None, **rest):
        index = self.add("nodes", {"name": name, **rest})
        if parent is None:
            self.json["scenes"][0]["nodes"].append(index)
        else:
            self.json["nodes"][parent].setdefault("children", []).append(index)
        return index

    def animate(self, node, path, times, values, interpolation):
        shape = {"translation": "VEC3", "scale": "VEC3", "rotation": "VEC4", "weights": "SCALAR"}
        animation = self.json["animations"][0]
        animation["samplers"].append({
            "input": self.accessor(np.asarray(times, "<f4"), FLOAT, "SCALAR", True),
            "output": self.accessor(np.asarray(values, "<f4"), FLOAT, shape[path]),
            "interpolation": interpolation})
        animation["channels"].append({"sampler": len(animation["samplers"]) - 1,
                                      "target": {"node": node, "path": path}})

    def pack(self):
        self.bytes += bytes(-len(self.bytes) % 4)
        self.json["buffers"] = [{"byteLength": len(self.bytes)}]
        text = json.dumps(self.json, separators=(",", ":")).encode()
        text += b" " * (-len(text) % 4)
        size = 12 + 8 + len(text) + 8 + len(self.bytes)
        return (struct.pack("<4sII", b"glTF", 2, size) + struct.pack("<I4s", len(text), b"JSON") +
                text + struct.pack("<I4s", len(self.bytes), b"BIN\0") + bytes(self.bytes))


# --- shapes: positions, normals, triangles --------------------------------------------------------


def box(size, centre=(0, 0, 0)):
    positions, normals, triangles = [], [], []
    for axis in range(3):
        for side in (-1, 1):
            normal, u, v = np.zeros(3), np.zeros(3), np.zeros(3)
            normal[axis], u[(axis + 1) % 3], v[(axis + 2) % 3] = side, side, 1
            first = len(positions)
            for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1)):
                positions.append((normal + a * u + b * v) * np.array(size) / 2 + np.array(centre))
                normals.append(normal)
            triangles += [(first, first + 1, first + 2), (first, first + 2, first + 3)]
    return np.array(positions), np.array(normals), np.array(triangles)


def lathe(profile, sides, caps=True):
    """Turns (radius, y) points around the y axis. Every piece of the profile is a smooth band."""
    positions, normals, triangles = [], [], []
    for (r0, y0), (r1, y1) in zip(profile, profile[1:]):
        first = len(positions)
        slope = np.array([y1 - y0, r0 - r1]) / math.hypot(y1 - y0, r0 - r1)
        for side in range(sides + 1):
            c, s = math.cos(2 * math.pi * side / sides), math.sin(2 * math.pi * side / sides)
            for r, y in ((r0, y0), (r1, y1)):
                positions.append((r * c, y, r * s))
                normals.append((slope[0] * c, slope[1], slope[0] * s))
        for side in range(sides):
            a = first + 2 * side
            triangles += [(a, a + 1, a + 3), (a, a + 3, a + 2)]
    return np.array(positions), np.array(normals), np.array(triangles)


def join(*shapes):
    positions, normals, triangles, first = [], [], [], 0
    for p, n, t in shapes:
        positions.append(p)
        normals.append(n)
        triangles.append(t + first)
        first += len(p)
    return np.concatenate(positions), np.concatenate(normals), np.concatenate(triangles)


def turned(shape, axis):
    """Lays a shape around y along another axis: x or z."""
    order = {"x": [1, 2, 0], "z": [2, 0, 1]}[axis]
    # A cyclic change of axes keeps the winding.
    return shape[0][:, order], shape[1][:, order], shape[2]


def rotation(axis, angle):
    q = [0.0, 0.0, 0.0, math.cos(angle / 2)]
    q["xyz".index(axis)] = math.sin(angle / 2)
    return q


# --- the pump -----------------------------------------------------------------------------------------


def wheel_shape():
    rim = turned(lathe([(0.78, -0.09), (0.95, -0.09), (0.95, 0.09), (0.78, 0.09), (0.78, -0.09)],
                       20), "z")
    spokes = [box((0.1, 1.6, 0.08)), box((1.6, 0.1, 0.08))]
    hub = turned(lathe([(0, -0.2), (0.16, -0.2), (0.16, 0.2), (0, 0.2)], 12), "z")
    pin = turned(lathe([(0, 0), (0.07, 0), (0.07, 0.3), (0, 0.3)], 8), "z")
    pin = (pin[0] + np.array([0.5, 0, 0.05]), pin[1], pin[2])
    return join(rim, *spokes, hub, pin)


def bellows_shape(height, radius):
    """A folded tube. Its folds are flatter and wider when it is pressed."""
    profile = [(0.2, 0)]
    for fold in range(8):
        profile.append((radius if fold % 2 == 0 else 0.6 * radius, height * (fold + 0.5) / 8))
    return lathe(profile + [(0.2, height)], 14)


def add_wheel(glb, parent, material):
    mesh = glb.mesh("wheel", material, wheel_shape())
    node = glb.node("wheel", parent, mesh=mesh, translation=[0, 1.25, 0.62])
    times = [0, 0.5, 1.0, 1.5, 2.0]
    glb.animate(node, "rotation", times, [rotation("z", -math.pi * t) for t in times], "LINEAR")


def add_piston(glb, parent, material):
    rod = join(lathe([(0, -0.7), (0.09, -0.7), (0.09, 0.5), (0, 0.5)], 10),
               lathe([(0, 0.5), (0.34, 0.5), (0.34, 0.62), (0, 0.62)], 14))
    mesh = glb.mesh("piston", material, rod)
    node = glb.node("piston", parent, mesh=mesh, translation=[1.25, 1.7, 0])
    times, values = [0, 0.5, 1.0, 1.5, 2.0], []
    for t in times:  # a cosine with its exact tangents
        slope = [0, -0.35 * math.pi * math.sin(math.pi * t), 0]
        values += [slope, [1.25, 1.7 + 0.35 * math.cos(math.pi * t), 0], slope]
    glb.animate(node, "translation", times, values, "CUBICSPLINE")


def add_bellows(glb, parent, material):
    shapes = [bellows_shape(0.9, 0.42), bellows_shape(0.35, 0.52), bellows_shape(1.1, 0.36)]
    mesh = glb.mesh("bellows", material, shapes[0], shapes[1:], rest=[0, 0])
    node = glb.node("bellows", parent, mesh=mesh, translation=[-1.3, 0.6, 0])
    glb.animate(node, "weights", [0, 0.5, 1.0, 1.5, 2.0],
                [0, 0, 1, 0, 0, 0, 0, 1, 0, 0], "LINEAR")


def add_lamp(glb, parent, material):
    mesh = glb.mesh("lamp", material, lathe([(0, 0), (0.14, 0.03), (0.17, 0.14), (0.1, 0.27),
                                             (0, 0.3)], 10))
    node = glb.node("lamp", parent, mesh=mesh, translation=[0.2, 2.3, -0.3])
    glb.animate(node, "scale", [0, 1.0, 1.25, 1.5, 1.75, 2.0],
                [[1, 1, 1], [0.3] * 3, [1, 1, 1], [0.3] * 3, [1, 1, 1], [1, 1, 1]], "STEP")


def add_hose(glb, parent, material):
    """A tube along y with three joints, which swings."""
    length, rings, sides, joints = 1.5, 13, 8, 3
    profile = [(0, 0)] + [(0.1, length * i / (rings - 1)) for i in range(rings)] + [(0, length)]
    shape = lathe(profile, sides)
    along = shape[0][:, 1] / length * (joints - 1)
    low = np.minimum(along.astype(int), joints - 2)
    fraction = along - low
    numbers = np.zeros((len(along), 4))
    weights = np.zeros((len(along), 4))
    numbers[:, 0], numbers[:, 1] = low, low + 1
    weights[:, 0], weights[:, 1] = 1 - fraction, fraction
    numbers[weights == 0] = 0
    mesh = glb.mesh("hose", material, shape, joints=numbers, weights=weights)
    step = length / (joints - 1)
    place = np.array([-0.75, 2.15, -0.25])
    nodes = [glb.node("hose_root", parent, translation=place.tolist())]
    for i in range(1, joints):
        nodes.append(glb.node(f"hose_{i}", nodes[-1], translation=[0, step, 0]))
    binds = np.zeros((joints, 4, 4))
    for i in range(joints):
        binds[i] = np.eye(4)
        binds[i, 1, 3] = -i * step
    skin = glb.add("skins", {"name": "hose", "joints": nodes, "inverseBindMatrices": glb.accessor(
        np.transpose(binds, (0, 2, 1)).reshape(joints, 16).astype("<f4"), FLOAT, "MAT4")})
    glb.node("hose", parent, mesh=mesh, skin=skin)
    times = np.linspace(0, DURATION, 9)
    for i, node in enumerate(nodes):
        swing = [0.12 + 0.3 * math.sin(math.pi * t - 0.8 * i) for t in times]
        glb.animate(node, "rotation", times, [rotation("z", a) for a in swing], "LINEAR")


def glb():
    model = Glb()
    iron = model.material("iron", (0.05, 0.06, 0.07), 0.5)
    brass = model.material("brass", (0.70, 0.42, 0.10), 0.3)
    red = model.material("red", (0.45, 0.03, 0.02), 0.5)
    leather = model.material("leather", (0.20, 0.08, 0.03), 0.9)
    lamp = model.material("lamp", (1.0, 0.75, 0.25), 0.2)
    frame = join(box((4, 0.3, 1.6), (0, 0.15, 0)), box((1.2, 2, 0.9), (0, 1.3, 0)),
                 box((1.0, 0.3, 0.9), (-1.3, 0.45, 0)))
    root = model.node("pump", mesh=model.mesh("frame", iron, frame))
    cylinder = lathe([(0, 0.3), (0.42, 0.3), (0.42, 1.5), (0.3, 1.5), (0.3, 0.9)], 16)
    model.node("cylinder", root, translation=[1.25, 0, 0],
               mesh=model.mesh("cylinder", brass, cylinder))
    add_wheel(model, root, red)
    add_piston(model, root, iron)
    add_bellows(model, root, leather)
    add_lamp(model, root, lamp)
    add_hose(model, root, brass)
    return model.pack()
