#!/usr/bin/env python3
"""Makes the torture scene: torture.gltf, torture.bin and its pictures.

Usage: scene.py FOLDER

A canal between two quays. Each camera shows what is hard for one technique: WIRES, FOLIAGE,
SPECULAR, TEXT and WATER; TOUR passes all of them.
"""
import json
import math
import pathlib
import sys

import numpy as np
from PIL import Image, ImageDraw

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent))

import art
import parts
from surfaces import MATERIALS
from mesh import Mesh, place
from noise import blur, save_jpeg
from paths import closed_curve, looking

SUN = np.array([-0.42, 0.67, 0.61]) / np.linalg.norm([-0.42, 0.67, 0.61])  # the renderer's
SUNNY, SHADE = np.array([0.99, 0.95, 0.88]), np.array([0.40, 0.44, 0.52])  # light, linear

# The canal, and the part of the ground that has a light map: lower and upper x, lower and upper z.
CANAL_Z = (-12.0, 0.0)
LIT = (-40.0, 40.0, -40.0, 16.0)
LIGHT_SIZE = (960, 672)


class Scene:

    def __init__(self):
        self.placements = []  # (mesh, matrix, casts a shadow)

    def add(self, mesh, x=0.0, y=0.0, z=0.0, turn_deg=0.0, scale=1.0, shadow=True):
        self.placements.append((mesh, place(x, y, z, turn_deg, scale), shadow))


# --- what stands where ---------------------------------------------------------------------------


def strip(mesh, material, z0, z1, x0=LIT[0], x1=LIT[1], y=0.0):
    mesh.flat(material, [(x0, y, z1), (x1, y, z1), (x1, y, z0), (x0, y, z0)])


def ground(scene):
    lit = Mesh("ground")
    strip(lit, "paving", 0.45, 6.6)
    strip(lit, "setts", 6.6, 9.4)
    strip(lit, "paving", 9.4, LIT[3])
    strip(lit, "paving", -15.0, CANAL_Z[0] - 0.45)
    strip(lit, "grass", LIT[2], -15.0)
    scene.add(lit, shadow=False)
    plain = Mesh("meadow")
    strip(plain, "meadow", -170.0, LIT[2], -170.0, 170.0)
    strip(plain, "meadow", LIT[3], 60.0, -170.0, 170.0)
    for x0, x1 in ((-170.0, LIT[0]), (LIT[1], 170.0)):
        strip(plain, "meadow", LIT[2], CANAL_Z[0], x0, x1)
        strip(plain, "meadow", CANAL_Z[1], LIT[3], x0, x1)
    scene.add(plain, shadow=False)
    walls = Mesh("quays")
    for z, side in ((CANAL_Z[0], 1), (CANAL_Z[1], -1)):
        low, high = (-170.0, z - 0.45 if side > 0 else z), (170.0, z if side > 0 else z + 0.45)
        walls.box("ashlar", (low[0], -2.0, low[1]), (high[0], 0.02, high[1]), "blr", 0.45)
    scene.add(walls, shadow=False)
    water = Mesh("canal")
    strip(water, "water", *CANAL_Z, -170.0, 170.0, parts.WATER_M)
    scene.add(water, shadow=False)
    sky = Mesh("sky")
    h = 6000.0
    sky.flat("sky", [(-h, 130, -h), (h, 130, -h), (h, 130, h), (-h, 130, h)])
    scene.add(sky, shadow=False)
    scene.add(parts.hills(150.0, 7.0, 3, (0.19, 0.26, 0.20)), shadow=False)
    scene.add(parts.hills(168.0, 15.0, 4, (0.34, 0.42, 0.46)), shadow=False)


def tramway(scene):
    mast, catenary = parts.mast(), parts.catenary()
    for i in range(-5, 8):
        x = i * parts.SPAN_M - 6.0
        if -42 < x < 80:
            scene.add(mast, x, 0, 10.2)
        scene.add(catenary, x, 0, parts.WIRE_Z, shadow=False)
    rails = Mesh("rails")
    for z in (parts.WIRE_Z - 0.72, parts.WIRE_Z + 0.72):
        rails.box("rail", (-100, 0.0, z - 0.035), (100, 0.02, z + 0.035), "blr")
    scene.add(rails, shadow=False)
    feet = [(-100.0, -62.0), (-34.0, -50.0), (62.0, -22.0), (150.0, 4.0)]
    pylon = parts.pylon()
    for x, z in feet[1:3]:
        scene.add(pylon, x, 0, z, shadow=False)
    scene.add(parts.power_line(feet), shadow=False)


def far_quay(scene):
    railing = parts.railing()
    for i in range(-14, 20):
        scene.add(railing, 3.0 * i, 0.02, CANAL_Z[0] - 0.2)
    for i in range(8, 20):
        scene.add(railing, 3.0 * i + 1.0, 0.02, CANAL_Z[1] + 0.2)
    scene.add(parts.hall(), 4.0, 0, -17.5)
    scene.add(parts.cladding(24, 21), 4.0, 0.7, -17.44, shadow=False)
    silo = parts.silo()
    scene.add(silo, -1.2, 0, -18.6)
    scene.add(silo, -5.2, 0, -19.2)
    houses = (parts.house("plaster", 8.0, 6.4, (3, 2)), parts.house("brick", 7.0, 7.4, (2, 2)),
              parts.house("plaster", 6.4, 7.8, (2, 2)))
    for i, x in enumerate((-37.5, -29.6, -22.4, -14.4, -6.2, 33.0)):
        scene.add(houses[i % 3], x, 0, -29.0 - (i * 7 % 3))


def trees(scene):
    lindens = (parts.tree(11, [((0, 3.3, 0), 1.35, 84), ((0.85, 2.75, 0.3), 0.9, 46),
                               ((-0.75, 2.8, -0.35), 0.95, 46), ((0.1, 4.3, -0.1), 0.85, 40)], 2.4),
               parts.tree(12, [((0, 3.1, 0), 1.25, 78), ((-0.6, 3.9, 0.25), 1.0, 50),
                               ((0.7, 3.2, -0.4), 0.95, 46)], 2.2))
    for i, x in enumerate((-32.0, -27.2, -22.3, -17.6, -12.8, -8.6)):
        scene.add(lindens[i % 2], x, 0, -16.0 - 0.5 * (i % 2), 67.0 * i, 1.05 + 0.1 * (i * 5 % 3))
    for i, (x, z) in enumerate(((-19.5, 3.4), (-15.6, 4.2), (-23.6, 3.9), (-27.5, 3.3))):
        scene.add(lindens[(i + 1) % 2], x, 0, z, 40.0 + 95.0 * i, 0.95 + 0.08 * i)
    for i, (x, z) in enumerate(((31.5, -15.4), (35.5, -16.6), (30.0, 13.6), (-33.5, 13.0))):
        scene.add(lindens[i % 2], x, 0, z, 20.0 + 80.0 * i, 1.1)
    for i, (x, z) in enumerate(((58.0, 3.2), (66.0, 17.0), (72.0, 21.0), (88.0, 14.0), (104.0, 22.0),
                                (80.0, -34.0), (92.0, -28.0), (108.0, -36.0), (-52.0, 18.0),
                                (-64.0, -22.0), (-76.0, 12.0), (52.0, -40.0))):
        scene.add(lindens[i % 2], x, 0, z, 50.0 * i, 1.1 + 0.14 * (i * 3 % 4), False)
    net = parts.net_fence()
    for i in range(6):
        scene.add(net, -28.0 + 3.0 * i, 0, 5.9)


def near_quay(scene):
    bollard = parts.bollard()
    for i in range(-6, 5):
        scene.add(bollard, 5.0 * i + 1.5, 0, 0.9)
    pipes = parts.pipes()
    scene.add(pipes, 12.0, 0, 3.0, 4.0)
    scene.add(pipes, 18.6, 0, 2.9, -3.0)
    plates = Mesh("plates")
    plates.box("plate", (8.0, 0.0, 4.9), (21.0, 0.03, 6.5), "b")
    scene.add(plates, shadow=False)
    # The same departures at four distances, a chart and small print, for those who look along +x.
    # The nearest one stands before a mast, so that the mast does not hide it.
    for x, z, foot in ((-6.5, 10.5, 1.0), (4.0, 11.4, 1.3), (14.0, 11.2, 1.6), (27.0, 11.0, 1.9)):
        scene.add(parts.board(art.BOARD, 1.7, 1.7, foot), x, 0, z, -90.0)
    scene.add(parts.board(art.CHART, 1.3, 2.6, 0.5), -1.0, 0, 5.6, -90.0)
    scene.add(parts.board(art.COLUMN, 1.7, 1.7, 0.9), 6.0, 0, 5.2, -90.0)
    scene.add(parts.board(art.SIGN, 1.6, 1.6, 2.4), 22.0, 0, 5.6, -90.0)
    letters = parts.lettered_ground()
    for x in (-6.5, 4.0, 15.0):
        scene.add(letters, x, 0, parts.WIRE_Z, shadow=False)
    scene.add(parts.ship(), -9.0, 0, -9.2, shadow=False)


def torture():
    scene = Scene()
    for build in (ground, tramway, far_quay, trees, near_quay):
        build(scene)
    return scene


# --- cameras -------------------------------------------------------------------------------------

# name: (vertical field of view, loop in seconds, [(position, target), ...])
CAMERAS = {
    "WIRES": (45, 16, [
        ((23.2, 1.7, 4.6), (40.0, 5.3, 0.9)),
        ((23.8, 1.75, 4.4), (40.4, 5.5, 0.7)),
        ((24.6, 1.8, 4.6), (41.2, 5.4, 0.8)),
        ((23.8, 1.75, 4.9), (40.8, 5.2, 1.1)),
    ]),
    "FOLIAGE": (45, 16, [
        ((-24.0, 1.65, 8.4), (-18.6, 2.3, 2.0)),
        ((-23.4, 1.65, 8.6), (-18.2, 2.4, 2.0)),
        ((-22.6, 1.7, 8.5), (-17.8, 2.4, 2.0)),
        ((-23.4, 1.65, 8.3), (-18.4, 2.3, 2.0)),
    ]),
    "SPECULAR": (45, 16, [
        ((20.6, 1.9, 9.6), (9.6, 0.9, -8.0)),
        ((20.0, 1.95, 9.4), (9.0, 0.95, -8.0)),
        ((19.2, 2.0, 9.3), (8.4, 0.9, -8.0)),
        ((20.0, 1.95, 9.5), (8.8, 0.85, -8.0)),
    ]),
    "TEXT": (45, 16, [
        ((-14.4, 1.6, 8.3), (6.0, 1.6, 8.7)),
        ((-13.6, 1.6, 8.2), (6.6, 1.6, 8.8)),
        ((-12.9, 1.65, 8.3), (6.6, 1.6, 8.9)),
        ((-13.6, 1.6, 8.4), (6.0, 1.6, 8.8)),
    ]),
    "WATER": (45, 16, [
        ((1.4, 1.3, 0.6), (-5.0, 0.1, -14.0)),
        ((2.2, 1.35, 0.6), (-4.4, 0.1, -14.0)),
        ((3.0, 1.4, 0.7), (-3.6, 0.1, -14.0)),
        ((2.2, 1.35, 0.7), (-4.2, 0.05, -14.0)),
    ]),
    "TOUR": (50, 60, [
        ((-27.0, 1.7, 9.6), (-19.0, 2.4, 3.0)),
        ((-22.0, 1.7, 9.2), (-16.0, 2.6, 2.0)),
        ((-14.0, 1.8, 8.6), (-2.0, 4.2, -2.0)),
        ((-7.0, 1.7, 7.6), (2.0, 3.6, -8.0)),
        ((-3.0, 1.7, 3.4), (-5.0, 1.0, -14.0)),
        ((1.0, 1.7, 1.6), (-4.0, 0.8, -14.0)),
        ((5.0, 1.7, 3.4), (10.0, 1.6, -12.0)),
        ((8.0, 1.7, 7.2), (16.0, 1.2, -6.0)),
        ((6.0, 1.8, 9.0), (24.0, 2.0, 6.0)),
        ((-4.0, 1.9, 8.6), (14.0, 2.0, 8.4)),
        ((-13.0, 2.0, 8.4), (4.0, 2.2, 7.0)),
        ((-22.0, 1.9, 8.8), (-8.0, 2.2, 4.0)),
    ]),
}
KEY_S, SAMPLE_S = 0.25, 1 / 120  # from key to key; Diptych samples animations 120 times a second


def keys_of(loop_s, views):
    """Times, positions and orientations of a loop. The last sample is followed by the first."""
    times = [KEY_S * i for i in range(round(loop_s / KEY_S))] + [loop_s - SAMPLE_S]
    positions, orientations = [], []
    for t in times:
        position = closed_curve([p for p, _ in views], t / loop_s)
        q = looking(position, closed_curve([p for _, p in views], t / loop_s))
        if orientations and np.dot(q, orientations[-1]) < 0:
            q = [-v for v in q]
        positions.append(position)
        orientations.append(q)
    return times, positions, orientations


# --- light ---------------------------------------------------------------------------------------


def light_map(scene, file):
    """The sun's shadows on the ground, and the dark where something touches it. A shadow is the
    projection of all triangles along the sun; leaf cards count as ellipses."""
    scale = 2
    size = (LIGHT_SIZE[0] * scale, LIGHT_SIZE[1] * scale)
    shadow, touch = (Image.new("L", size, 0) for _ in range(2))
    draw, draw_touch = ImageDraw.Draw(shadow), ImageDraw.Draw(touch)

    def texels(p):
        x = (p[..., 0] - LIT[0]) / (LIT[1] - LIT[0]) * size[0]
        z = (p[..., 2] - LIT[2]) / (LIT[3] - LIT[2]) * size[1]
        return np.stack([x, z], -1)

    for mesh, matrix, casts in scene.placements:
        if not casts:
            continue
        for material, surface in mesh.surfaces.items():
            points = np.asarray(surface.positions) @ matrix[:3, :3].T + matrix[:3, 3]
            cast = texels(points - SUN * (points[:, 1:2] / SUN[1]))
            low = texels(points)
            leaves = MATERIALS[material].kind == "mask"
            for i, (a, b, c) in enumerate(surface.triangles):
                if leaves:
                    if material == "leaf" and i % 2 == 0:
                        (x0, y0), (x1, y1) = cast[[a, c]].min(0), cast[[a, c]].max(0)
                        draw.ellipse((x0, y0, x1, y1), 255)
                    continue
                draw.polygon([tuple(p) for p in cast[[a, b, c]]], 255)
                if points[[a, b, c], 1].max() < 0.75:
                    draw_touch.polygon([tuple(p) for p in low[[a, b, c]]], 255)

    def reduced(picture, sigma):
        field = np.asarray(picture, np.float32) / 255.0
        field = field.reshape(LIGHT_SIZE[1], scale, LIGHT_SIZE[0], scale).mean((1, 3))
        return np.clip(blur(field, sigma), 0.0, 1.0)[..., None]

    light = SUNNY + (SHADE - SUNNY) * reduced(shadow, 0.9)
    light = light * (1.0 - 0.55 * reduced(touch, 3.0))
    half = np.clip(light / 2.0, 0.0, 1.0)
    srgb = np.where(half <= 0.0031308, 12.92 * half, 1.055 * half**(1 / 2.4) - 0.055)
    save_jpeg(file, srgb, 80)


# --- glTF ----------------------------------------------------------------------------------------

FLOAT, UINT16, UINT8 = 5126, 5123, 5121
ARRAY, ELEMENTS = 34962, 34963
TAGS = {"solid": {"surface": "solid"}, "mask": {"surface": "mask"}, "water": {"surface": "water"},
        "sky": {"surface": "sky"}, "ground": {"surface": "solid", "lightmapped": 1}, "metal": None}


def rounded(values, step):
    return (np.rint(np.asarray(values, float) / step) * step + 0.0).astype(np.float32)


class Writer:

    def __init__(self):
        self.json = {
            "asset": {"version": "2.0", "generator": "Diptych assets/author/torture"}, "scene": 0,
            "scenes": [{"nodes": []}], "nodes": [], "meshes": [], "cameras": [], "animations": [],
            "materials": [], "textures": [], "images": [], "accessors": [], "bufferViews": [],
            "buffers": [], "samplers": [{"wrapS": 10497, "wrapT": 10497}]
        }
        self.bytes = bytearray()
        self.known = {}  # what is written only once, and its index
        self.meshes = {}  # name: [(index, kind)]

    def once(self, kind, key, value):
        if (kind, key) not in self.known:
            self.known[kind, key] = len(self.json[kind])
            self.json[kind].append(value)
        return self.known[kind, key]

    def accessor(self, array, component, shape, target=None, bounds=False):
        entry = {"componentType": component, "count": len(array), "type": shape}
        if component == UINT8:
            entry["normalized"] = True
        if bounds:
            entry["min"] = np.atleast_1d(array.min(0)).tolist()
            entry["max"] = np.atleast_1d(array.max(0)).tolist()
        data = array.tobytes()
        if ("data", data) not in self.known:
            self.known["data", data] = len(self.json["bufferViews"])
            self.bytes += bytes(-len(self.bytes) % 4)
            view = {"buffer": 0, "byteOffset": len(self.bytes), "byteLength": len(data)}
            self.json["bufferViews"].append(view if target is None else view | {"target": target})
            self.bytes += data
        entry["bufferView"] = self.known["data", data]
        return self.once("accessors", json.dumps(entry, sort_keys=True), entry)

    def texture(self, picture):
        image = self.once("images", picture, {"uri": picture})
        return {"index": self.once("textures", picture, {"source": image, "sampler": 0})}

    def material(self, name):
        source = MATERIALS[name]
        shading = {"metallicFactor": source.metallic, "roughnessFactor": source.roughness}
        value = {"name": name, "pbrMetallicRoughness": shading}
        if source.colour_lin != (1.0, 1.0, 1.0):
            shading["baseColorFactor"] = [*source.colour_lin, 1.0]
        if source.picture:
            shading["baseColorTexture"] = self.texture(source.picture)
        if source.normal_map:
            value["normalTexture"] = self.texture(source.normal_map)
        if source.kind == "ground":
            value["occlusionTexture"] = self.texture("light.jpg") | {"texCoord": 1}
        if source.kind == "mask":
            value.update(alphaMode="MASK", alphaCutoff=0.5)
        if source.double_sided:
            value["doubleSided"] = True
        return self.once("materials", name, value)

    def primitive(self, name, surface):
        source = MATERIALS[name]
        positions = np.asarray(surface.positions)
        columns = [("POSITION", "VEC3", rounded(positions, 1 / 4096)),
                   ("NORMAL", "VEC3", rounded(surface.normals, 1 / 1024))]
        if source.picture or source.normal_map:
            columns.append(("TEXCOORD_0", "VEC2", rounded(np.asarray(surface.uvs) / source.tile_m,
                                                          1 / 4096)))
        if source.kind == "ground":
            uvs = (positions[:, [0, 2]] - (LIT[0], LIT[2])) / (LIT[1] - LIT[0], LIT[3] - LIT[2])
            columns.append(("TEXCOORD_1", "VEC2", rounded(uvs, 1 / 32768)))
        colours = np.asarray(surface.colours)
        if (colours != 1.0).any():
            columns.append(("COLOR_0", "VEC4", np.concatenate(
                [rounded(np.clip(colours, 0, 1), 1 / 255), np.ones((len(colours), 1))],
                1).astype(np.float32)))
        corners = np.concatenate([column for _, _, column in columns], 1)
        _, first, inverse = np.unique(corners, axis=0, return_index=True, return_inverse=True)
        order = np.argsort(first)  # vertices in the order of their first use
        rank = np.empty(len(order), int)
        rank[order] = np.arange(len(order))
        kept = first[order]
        indices = rank[inverse.ravel()][np.asarray(surface.triangles)].astype(np.uint16).ravel()
        attributes = {}
        for attribute, shape, column in columns:
            values = np.ascontiguousarray(column[kept])
            if attribute == "COLOR_0":
                values = np.rint(values * 255).astype(np.uint8)
                attributes[attribute] = self.accessor(values, UINT8, shape, ARRAY)
            else:
                attributes[attribute] = self.accessor(values, FLOAT, shape, ARRAY,
                                                      attribute == "POSITION")
        return {"attributes": attributes, "material": self.material(name),
                "indices": self.accessor(indices, UINT16, "SCALAR", ELEMENTS)}

    def meshes_of(self, mesh):
        """One glTF mesh for each kind of material, since a node's tag holds for all of its mesh."""
        if mesh.name not in self.meshes:
            kinds = {}
            for name, surface in mesh.surfaces.items():
                kinds.setdefault(MATERIALS[name].kind, []).append(self.primitive(name, surface))
            self.meshes[mesh.name] = []
            for kind, primitives in kinds.items():
                self.meshes[mesh.name].append((len(self.json["meshes"]), kind))
                self.json["meshes"].append({"name": f"{mesh.name}_{kind}",
                                            "primitives": primitives})
        return self.meshes[mesh.name]

    def node(self, node):
        self.json["scenes"][0]["nodes"].append(len(self.json["nodes"]))
        self.json["nodes"].append(node)

    def add(self, mesh, matrix):
        for index, kind in self.meshes_of(mesh):
            node = {"name": mesh.name, "mesh": index}
            if TAGS[kind]:
                node["extras"] = TAGS[kind]
            matrix = np.round(matrix, 6) + 0.0
            if not np.array_equal(matrix, np.eye(4)):
                node["matrix"] = matrix.T.ravel().tolist()
            self.node(node)

    def camera(self, name, fov_deg, loop_s, views):
        times, positions, orientations = keys_of(loop_s, views)
        camera = {"type": "perspective", "perspective": {
            "yfov": round(math.radians(fov_deg), 9), "aspectRatio": 1.333333, "znear": 0.1}}
        self.json["cameras"].append(camera)
        self.node({"name": name, "camera": len(self.json["cameras"]) - 1,
                   "translation": [round(v, 6) for v in positions[0]],
                   "rotation": [round(v, 9) for v in orientations[0]]})
        if not self.json["animations"]:
            self.json["animations"].append({"name": "flight", "channels": [], "samplers": []})
        flight = self.json["animations"][0]
        time = self.accessor(np.asarray(times, np.float32), FLOAT, "SCALAR", None, True)
        for path, values, shape in (("translation", positions, "VEC3"),
                                    ("rotation", orientations, "VEC4")):
            flight["channels"].append({
                "sampler": len(flight["samplers"]),
                "target": {"node": len(self.json["nodes"]) - 1, "path": path}
            })
            flight["samplers"].append({
                "input": time, "interpolation": "LINEAR",
                "output": self.accessor(np.asarray(values, np.float32), FLOAT, shape)
            })

    def write(self, folder):
        self.json["buffers"] = [{"uri": "torture.bin", "byteLength": len(self.bytes)}]
        (folder / "torture.bin").write_bytes(self.bytes)
        text = json.dumps(self.json, separators=(",", ":"))
        for key in self.json:
            text = text.replace(f'"{key}":[', f'\n"{key}":[\n')
        (folder / "torture.gltf").write_text(text.replace("},{", "},\n{") + "\n")


def main(folder):
    folder.mkdir(parents=True, exist_ok=True)
    art.make(folder)
    scene = torture()
    light_map(scene, folder / "light.jpg")
    writer = Writer()
    for mesh, matrix, _ in scene.placements:
        writer.add(mesh, matrix)
    for name, camera in CAMERAS.items():
        writer.camera(name, *camera)
    writer.write(folder)
    triangles = sum(len(s.triangles) for mesh, _, _ in scene.placements
                    for s in mesh.surfaces.values())
    print(f"{triangles} triangles in {len(writer.json['nodes'])} nodes; "
          f"{sum(f.stat().st_size for f in folder.iterdir())} bytes")


if __name__ == "__main__":
    main(pathlib.Path(sys.argv[1]))
