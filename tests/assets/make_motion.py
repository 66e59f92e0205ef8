#!/usr/bin/python3
"""Makes data/motion.gltf, and evaluates it and the gallery's pump as the glTF specification says.

Needs (Debian): python3-numpy

The evaluation follows glTF 2.0, appendix C (animation sampler interpolation modes), section 3.7.2.2
(morph targets) and 3.7.3 (skins), with 4x4 matrices in numpy. Each line of motion.txt and pump.txt
is one vertex: time, object, vertex, position and normal in the world.
"""
import base64
import json
import math
import pathlib
import struct

import numpy as np

HERE = pathlib.Path(__file__).resolve().parent
DATA = HERE / "data"
COMPONENTS = {5120: "i1", 5121: "u1", 5122: "<i2", 5123: "<u2", 5125: "<u4", 5126: "<f4"}
WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT4": 16}

# --- evaluation -----------------------------------------------------------------------------------


class Document:

    def __init__(self, path):
        data = path.read_bytes()
        if data[:4] == b"glTF":
            size = struct.unpack_from("<I", data, 12)[0]
            self.json = json.loads(data[20:20 + size])
            self.buffer = data[20 + size + 8:]
        else:
            self.json = json.loads(data)
            uri = self.json["buffers"][0]["uri"]
            self.buffer = base64.b64decode(uri.split(",", 1)[1])

    def values(self, index):
        accessor = self.json["accessors"][index]
        view = self.json["bufferViews"][accessor["bufferView"]]
        width = WIDTHS[accessor["type"]]
        kind = np.dtype(COMPONENTS[accessor["componentType"]])
        stride = view.get("byteStride", kind.itemsize * width)
        start = view.get("byteOffset", 0) + accessor.get("byteOffset", 0)
        rows = [np.frombuffer(self.buffer, kind, width, start + i * stride)
                for i in range(accessor["count"])]
        values = np.array(rows, float)
        if accessor.get("normalized"):
            top = {"i1": 127, "u1": 255, "<i2": 32767, "<u2": 65535}[COMPONENTS[
                accessor["componentType"]]]
            values = np.maximum(values / top, -1)
        return values

    def rest(self):
        state = []
        for node in self.json["nodes"]:
            weights = []
            if "mesh" in node:
                mesh = self.json["meshes"][node["mesh"]]
                count = len(mesh["primitives"][0].get("targets", []))
                weights = node.get("weights", mesh.get("weights", [0.0] * count))
            state.append({"translation": np.array(node.get("translation", [0, 0, 0]), float),
                          "rotation": np.array(node.get("rotation", [0, 0, 0, 1]), float),
                          "scale": np.array(node.get("scale", [1, 1, 1]), float),
                          "weights": np.array(weights, float)})
        return state

    def pose(self, animation, time):
        state = self.rest()
        for channel in animation["channels"]:
            sampler = animation["samplers"][channel["sampler"]]
            node, path = channel["target"]["node"], channel["target"]["path"]
            times = self.values(sampler["input"])[:, 0]
            output = self.values(sampler["output"])
            if path == "weights":
                output = output.reshape(-1, len(state[node]["weights"]))
            state[node][path] = sample(times, output, sampler.get("interpolation", "LINEAR"), path,
                                       time)
        return state


def slerp(a, b, t):
    """The formula of appendix C.4, whose angle is an arc cosine."""
    cosine = float(np.dot(a, b))
    sign = -1.0 if cosine < 0 else 1.0
    angle = math.acos(min(abs(cosine), 1.0))
    if angle < 1e-9:
        return a
    return (math.sin(angle * (1 - t)) * a + sign * math.sin(angle * t) * b) / math.sin(angle)


def sample(times, output, mode, path, time):
    def value(key):
        return output[3 * key + 1] if mode == "CUBICSPLINE" else output[key]

    if time <= times[0]:
        return value(0)
    if time >= times[-1]:
        return value(len(times) - 1)
    k = int(np.searchsorted(times, time, side="right")) - 1
    td = times[k + 1] - times[k]
    t = (time - times[k]) / td
    if mode == "STEP":
        return value(k)
    if mode == "LINEAR":
        if path == "rotation":
            a, b = (q / np.linalg.norm(q) for q in (value(k), value(k + 1)))
            return slerp(a, b, t)
        return (1 - t) * value(k) + t * value(k + 1)
    b, a = output[3 * k + 2], output[3 * (k + 1)]
    return ((2 * t**3 - 3 * t**2 + 1) * value(k) + td * (t**3 - 2 * t**2 + t) * b +
            (-2 * t**3 + 3 * t**2) * value(k + 1) + td * (t**3 - t**2) * a)


def rotate(q, v):
    """q v q*, by quaternion products."""

    def product(p, r):
        return np.array([*(p[3] * r[:3] + r[3] * p[:3] + np.cross(p[:3], r[:3])),
                         p[3] * r[3] - np.dot(p[:3], r[:3])])

    return product(product(q, np.array([*v, 0.0])), q * np.array([-1, -1, -1, 1]))[:3]


def local(node, state):
    if "matrix" in node:
        return np.array(node["matrix"], float).reshape(4, 4).T
    q = state["rotation"] / np.linalg.norm(state["rotation"])
    matrix = np.eye(4)
    for axis in range(3):
        matrix[:3, axis] = rotate(q, np.eye(3)[axis]) * state["scale"][axis]
    matrix[:3, 3] = state["translation"]
    return matrix


def worlds(document, state):
    nodes = document.json["nodes"]
    parent = {child: i for i, node in enumerate(nodes) for child in node.get("children", [])}

    def world(i):
        own = local(nodes[i], state[i])
        return world(parent[i]) @ own if i in parent else own

    return [world(i) for i in range(len(nodes))]


def unit(rows):
    return rows / np.linalg.norm(rows, axis=1, keepdims=True)


def shaped(document, primitive, weights):
    attributes = primitive["attributes"]
    positions = document.values(attributes["POSITION"])
    normals = unit(document.values(attributes["NORMAL"]))
    for weight, target in zip(weights, primitive.get("targets", [])):
        positions = positions + weight * document.values(target["POSITION"])
        if "NORMAL" in target:
            normals = normals + weight * document.values(target["NORMAL"])
    return positions, normals


def skinned(document, primitive, skin, world, positions, normals):
    joints = document.values(primitive["attributes"]["JOINTS_0"]).astype(int)
    weights = document.values(primitive["attributes"]["WEIGHTS_0"])
    weights = weights / weights.sum(1, keepdims=True)
    binds = document.values(skin["inverseBindMatrices"]).reshape(-1, 4, 4).transpose(0, 2, 1)
    matrices = np.array([world[node] @ bind for node, bind in zip(skin["joints"], binds)])
    mixed = (weights[:, :, None, None] * matrices[joints]).sum(1)
    points = np.concatenate([positions, np.ones((len(positions), 1))], 1)
    return (np.einsum("vij,vj->vi", mixed, points)[:, :3],
            np.einsum("vij,vj->vi", mixed[:, :3, :3], normals))


def evaluate(document, animation, time):
    """Returns positions and normals in the world for each object, in the order of the nodes. Normals
    of objects without a skin are turned by the matrix itself, as the C test does."""
    state = document.pose(animation, time)
    world = worlds(document, state)
    objects = []
    for i, node in enumerate(document.json["nodes"]):
        if "mesh" not in node:
            continue
        for primitive in document.json["meshes"][node["mesh"]]["primitives"]:
            positions, normals = shaped(document, primitive, state[i]["weights"])
            if "skin" in node:
                skin = document.json["skins"][node["skin"]]
                positions, normals = skinned(document, primitive, skin, world, positions, normals)
            else:
                positions = positions @ world[i][:3, :3].T + world[i][:3, 3]
                normals = unit(normals) @ world[i][:3, :3].T
            objects.append((positions, unit(normals)))
    return objects


def write(document, name, times, every):
    animation = document.json["animations"][0]
    ends = [document.values(s["input"])[-1, 0] for s in animation["samplers"]]
    duration = max(ends)
    lines = []
    for time in times:
        for number, (positions, normals) in enumerate(
                evaluate(document, animation, time % duration)):
            for vertex in range(0, len(positions), every):
                numbers = " ".join(f"{x:.9g}" for x in [*positions[vertex], *normals[vertex]])
                lines.append(f"{time:.9g} {number} {vertex} {numbers}\n")
    (DATA / name).write_text("".join(lines))


# --- the file -------------------------------------------------------------------------------------


class Builder:

    def __init__(self):
        self.bytes = bytearray()
        self.json = {"asset": {"version": "2.0"}, "accessors": [], "bufferViews": []}

    def view(self, data, **more):
        self.bytes += bytes(-len(self.bytes) % 4)
        self.json["bufferViews"].append({"buffer": 0, "byteOffset": len(self.bytes),
                                         "byteLength": len(data), **more})
        self.bytes += data
        return len(self.json["bufferViews"]) - 1

    def accessor(self, values, component, shape, view=None, offset=0, normalized=False):
        array = np.asarray(values, COMPONENTS[component])
        entry = {"componentType": component, "type": shape,
                 "count": array.size // WIDTHS[shape],
                 "bufferView": self.view(array.tobytes()) if view is None else view}
        if offset:
            entry["byteOffset"] = offset
        if normalized:
            entry["normalized"] = True
        self.json["accessors"].append(entry)
        return len(self.json["accessors"]) - 1


def quaternion(axis, degrees, sign=1):
    axis = np.array(axis, float) / np.linalg.norm(axis)
    half = math.radians(degrees) / 2
    return sign * np.array([*(axis * math.sin(half)), math.cos(half)])


def motion():
    b = Builder()
    # Positions and normals share a view with a stride.
    positions = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0.5], [0, 1, 0]], "<f4")
    normals = np.array([[0, 0, 1], [0, 0.6, 0.8], [0, 0, 1], [0.6, 0, 0.8]], "<f4")
    shared = b.view(np.concatenate([positions, normals], 1).tobytes(), byteStride=24)
    position = b.accessor(positions, 5126, "VEC3", shared)
    normal = b.accessor(normals, 5126, "VEC3", shared, 12)
    indices = b.accessor([0, 1, 2, 0, 2, 3], 5123, "SCALAR")
    uv = b.accessor([0, 0, 255, 0, 255, 255, 0, 255], 5121, "VEC2", normalized=True)
    plain = {"attributes": {"POSITION": position, "NORMAL": normal, "TEXCOORD_0": uv},
             "indices": indices, "material": 0}
    rng = np.random.default_rng(5)
    target = [b.accessor(rng.uniform(-1, 1, (4, 3)), 5126, "VEC3") for _ in range(3)]
    morphed = {**plain, "targets": [{"POSITION": target[0], "NORMAL": target[1]},
                                    {"POSITION": target[2]}]}
    joints = b.accessor([0, 1, 2, 0, 2, 0, 0, 0, 1, 2, 0, 0, 0, 0, 0, 0], 5121, "VEC4")
    weights = b.accessor([128, 64, 63, 0, 255, 0, 0, 0, 100, 100, 0, 0, 0, 0, 0, 7], 5121, "VEC4",
                         normalized=True)
    bent = {"attributes": {"POSITION": position, "NORMAL": normal, "JOINTS_0": joints,
                           "WEIGHTS_0": weights}, "indices": indices, "material": 1}
    binds = []
    for i in range(3):
        matrix = np.eye(4)
        matrix[:3, 3] = [-0.3 * i, 0.2, -0.1 * i]
        binds.append(matrix.T)
    bind = b.accessor(binds, 5126, "MAT4")
    turn = np.eye(4)
    turn[:3, :3] = np.array([[0, 0, 2], [0, 2, 0], [-2, 0, 0]])
    turn[:3, 3] = [3, -1, 2]
    b.json["nodes"] = [
        {"name": "turned", "matrix": turn.T.ravel().tolist(), "children": [4, 1]},
        {"name": "stepping", "mesh": 0, "scale": [1, 2, 1]},
        {"name": "spline", "mesh": 0, "rotation": quaternion([1, 2, 3], 40).tolist()},
        {"name": "morphed", "mesh": 1, "weights": [0.25, -0.5], "translation": [0, 5, 0]},
        {"name": "spinning", "mesh": 0, "translation": [1, 2, 3]},
        {"name": "bent", "mesh": 2, "skin": 0, "translation": [100, 100, 100]},
        {"name": "joint0", "children": [7], "scale": [1.5, 1.5, 1.5]},
        {"name": "joint1", "children": [8], "translation": [0.3, 0, 0]},
        {"name": "joint2", "translation": [0.3, 0.1, 0]},
        {"name": "not shown", "mesh": 0},
    ]
    b.json["scenes"] = [{"nodes": []}, {"nodes": [0, 2, 3, 5, 6]}]
    b.json["scene"] = 1
    b.json["meshes"] = [{"name": "plain", "primitives": [plain]},
                        {"name": "morphed", "primitives": [morphed], "weights": [1, 1]},
                        {"name": "bent", "primitives": [bent]}]
    b.json["skins"] = [{"joints": [6, 7, 8], "inverseBindMatrices": bind}]
    png = base64.b64encode(bytes(PNG)).decode()
    b.json["images"] = [{"uri": "data:image/png;base64," + png}]
    b.json["samplers"] = [{"wrapS": 33071}]
    b.json["textures"] = [{"source": 0, "sampler": 0}]
    b.json["materials"] = [
        {"name": "checked", "alphaMode": "MASK", "alphaCutoff": 0.25,
         "pbrMetallicRoughness": {"baseColorTexture": {"index": 0}, "roughnessFactor": 0.5,
                                  "baseColorFactor": [0.5, 0.25, 1, 1]}},
        {"name": "two sides", "doubleSided": True}]
    b.json["animations"] = [animation(b), {"name": "still", "samplers": [], "channels": []}]
    b.json["buffers"] = [{"byteLength": len(b.bytes), "uri": "data:application/octet-stream;base64,"
                          + base64.b64encode(bytes(b.bytes)).decode()}]
    return json.dumps(b.json, indent=1)


def animation(b):
    samplers, channels = [], []

    def add(node, path, times, output, interpolation):
        sampler = {"input": b.accessor(times, 5126, "SCALAR"), "output": output}
        if interpolation:
            sampler["interpolation"] = interpolation
        samplers.append(sampler)
        channels.append({"sampler": len(samplers) - 1, "target": {"node": node, "path": path}})

    add(1, "translation", [0.25, 0.5, 1.0], b.accessor(
        [[0, 0, 0], [1, 2, 3], [-4, 5, 6]], 5126, "VEC3"), "STEP")
    # The second quaternion is on the other hemisphere; the fourth is hardly turned.
    spins = [quaternion([0, 1, 0], 0), quaternion([0, 1, 1], 100, -1), quaternion([1, 0, 0], 250),
             quaternion([1, 0, 0], 250.0001)]
    add(4, "rotation", [0, 0.4, 1.1, 1.5], b.accessor(
        np.rint(np.array(spins) * 32767), 5122, "VEC4", normalized=True), None)
    rng = np.random.default_rng(11)
    add(2, "translation", [0.1, 0.7, 1.6], b.accessor(
        rng.uniform(-2, 2, (9, 3)), 5126, "VEC3"), "CUBICSPLINE")
    rotations = []
    for degrees in (10, 80, 170):
        rotations += [rng.uniform(-1, 1, 4), quaternion([3, 1, 2], degrees), rng.uniform(-1, 1, 4)]
    add(2, "rotation", [0.1, 0.7, 1.6], b.accessor(rotations, 5126, "VEC4"), "CUBICSPLINE")
    add(2, "scale", [0, 2.0], b.accessor([[1, 1, 1], [2, 0.5, 3]], 5126, "VEC3"), "LINEAR")
    add(3, "weights", [0, 0.5, 2.0], b.accessor(
        rng.integers(-32768, 32768, 18), 5122, "SCALAR", normalized=True), "CUBICSPLINE")
    add(7, "rotation", [0, 1.0, 2.0], b.accessor(
        [quaternion([0, 0, 1], d) for d in (0, 70, -30)], 5126, "VEC4"), "LINEAR")
    add(8, "translation", [0, 2.0], b.accessor([[0.3, 0.1, 0], [0.5, 0, 0.2]], 5126, "VEC3"), None)
    return {"name": "all", "samplers": samplers, "channels": channels}


# 2x2 pixels: red, green; blue, white with alpha 0 (as in fixture.c).
PNG = bytes.fromhex(
    "89504e470d0a1a0a0000000d4948445200000002000000020806000000"
    "72b60d24000000134944415478da63f8cfc0f01f0c81340830000048c9"
    "08f8c534fd050000000049454e44ae426082")


def main():
    (DATA / "motion.gltf").write_text(motion())
    document = Document(DATA / "motion.gltf")
    # "not shown" is in no scene.
    shown = [node for node in document.json["nodes"] if node["name"] != "not shown"]
    document.json["nodes"] = shown
    times = [0, 0.05, 0.1, 0.25, 0.3, 0.4, 0.5, 0.77, 1.0, 1.1, 1.3, 1.55, 1.7, 1.95, 2.0, 2.3, 7.41,
             -0.35]
    write(document, "motion.txt", times, 1)
    pump = Document(HERE.parent.parent / "assets" / "gallery" / "pump.glb")
    write(pump, "pump.txt", [0, 0.33, 0.75, 1.125, 1.9, 3.3], 41)


if __name__ == "__main__":
    main()
