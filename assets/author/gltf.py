#!/usr/bin/env python3
"""Writes the courtyard as glTF: court.gltf, court.bin. Pictures are named, not copied.

Usage: gltf.py FOLDER SIDE   (size of the light map that was baked, in texels)

glTF has y up: (x, y, z) becomes (x, z, -y). Numbers are rounded so that the file packs well.
"""
import json
import pathlib
import sys

import numpy as np

import charts
import courtyard
from materials import MATERIALS

FLOAT, UINT16, UINT8 = 5126, 5123, 5121
ARRAY, ELEMENTS = 34962, 34963
REPEAT, CLAMP = 10497, 33071
Y_UP = np.array([[1, 0, 0, 0], [0, 0, 1, 0], [0, -1, 0, 0], [0, 0, 0, 1]], float)


def rounded(values, step):
    return (np.rint(np.asarray(values, float) / step) * step + 0.0).astype(np.float32)


class Writer:

    def __init__(self):
        self.json = {
            "asset": {"version": "2.0", "generator": "Diptych assets/author"}, "scene": 0,
            "scenes": [{"nodes": []}], "nodes": [], "meshes": [], "accessors": [],
            "bufferViews": [], "buffers": [], "materials": [], "textures": [], "images": [],
            "samplers": [{"magFilter": 9729, "minFilter": 9987, "wrapS": REPEAT, "wrapT": REPEAT},
                         {"magFilter": 9729, "minFilter": 9987, "wrapS": REPEAT, "wrapT": CLAMP}]
        }
        self.bytes = bytearray()
        self.known = {}  # views, materials and textures that are already written

    def once(self, kind, key, value):
        """Returns the index of an entry, which is written only the first time."""
        if (kind, key) not in self.known:
            self.known[kind, key] = len(self.json[kind])
            self.json[kind].append(value)
        return self.known[kind, key]

    def accessor(self, array, component, shape, target, bounds=False):
        """Equal arrays (a part under several lights) are stored once."""
        data = array.tobytes()
        entry = {"componentType": component, "count": len(array), "type": shape}
        if component == UINT8:
            entry["normalized"] = True
        if bounds:
            entry["min"], entry["max"] = array.min(0).tolist(), array.max(0).tolist()
        if ("data", data, component) not in self.known:
            self.known["data", data, component] = len(self.json["bufferViews"])
            self.bytes += bytes(-len(self.bytes) % 4)
            self.json["bufferViews"].append({
                "buffer": 0, "byteOffset": len(self.bytes), "byteLength": len(data),
                "target": target
            })
            self.bytes += data
        entry["bufferView"] = self.known["data", data, component]
        return self.once("accessors", json.dumps(entry, sort_keys=True), entry)

    def texture(self, picture, clamp_v=False):
        image = self.once("images", picture, {"uri": picture})
        return self.once("textures", (picture, clamp_v), {"source": image, "sampler": int(clamp_v)})

    def material(self, name):
        source = MATERIALS[name]
        shading = {"metallicFactor": 0, "roughnessFactor": source.roughness}
        if source.colour_lin != (1.0, 1.0, 1.0):
            shading["baseColorFactor"] = [*source.colour_lin, 1.0]
        if source.opacity < 1.0:
            shading["baseColorFactor"] = [*source.colour_lin, source.opacity]
        value = {"name": name, "pbrMetallicRoughness": shading}
        if source.picture:
            shading["baseColorTexture"] = {"index": self.texture(source.picture, source.clamp_v)}
        if source.normal_map:
            picture = source.picture.replace(".", "_n.")
            value["normalTexture"] = {"index": self.texture(picture)}
        if source.lightmapped:
            # Sets count from 0. A surface without a picture has only the light map's set.
            value["occlusionTexture"] = {
                "index": self.texture("light.jpg"), "texCoord": int(source.picture is not None)
            }
        if source.surface == "mask":
            value.update(alphaMode="MASK", alphaCutoff=0.5)
        elif source.opacity < 1.0:
            value["alphaMode"] = "BLEND"
        if source.double_sided:
            value["doubleSided"] = True
        return self.once("materials", name, value)

    def primitive(self, name, surface, light_uvs):
        source = MATERIALS[name]
        positions = np.asarray(surface.positions) @ Y_UP[:3, :3].T
        normals = np.asarray(surface.normals) @ Y_UP[:3, :3].T
        columns = [rounded(positions, 1 / 4096), rounded(normals, 1 / 256)]
        names, shapes = ["POSITION", "NORMAL"], ["VEC3", "VEC3"]
        if source.picture:
            uvs = np.asarray(surface.uvs) / np.asarray(source.tile_m) * (1, -1) + (0, 1)
            columns.append(rounded(uvs, 1 / 4096))
            names, shapes = names + ["TEXCOORD_0"], shapes + ["VEC2"]
        if source.lightmapped:
            columns.append(rounded(light_uvs, 1 / 32768))
            names, shapes = names + [f"TEXCOORD_{int(source.picture is not None)}"
                                     ], shapes + ["VEC2"]
        colours = np.asarray(surface.colours)
        if (colours != 1.0).any():
            columns.append(rounded(colours, 1 / 255))
            names, shapes = names + ["COLOR_0"], shapes + ["VEC3"]
        corners = np.concatenate(columns, 1)
        _, first, inverse = np.unique(corners, axis=0, return_index=True, return_inverse=True)
        order = np.argsort(first)  # vertices in the order of their first use
        rank = np.empty(len(order), int)
        rank[order] = np.arange(len(order))
        kept = corners[first[order]]
        indices = rank[inverse][np.asarray(surface.triangles)].astype(np.uint16).ravel()
        if len(kept) > 65535:
            raise ValueError(f"{name}: {len(kept)} vertices do not fit 16-bit indices")
        attributes, at = {}, 0
        for attribute, shape, column in zip(names, shapes, columns):
            values = np.ascontiguousarray(kept[:, at:at + column.shape[1]])
            at += column.shape[1]
            if attribute == "COLOR_0":
                opaque = np.full((len(values), 1), 1.0)
                values = np.rint(np.concatenate([values, opaque], 1) * 255).astype(np.uint8)
                attributes[attribute] = self.accessor(values, UINT8, "VEC4", ARRAY)
            else:
                attributes[attribute] = self.accessor(values, FLOAT, shape, ARRAY,
                                                      attribute == "POSITION")
        return {
            "attributes": attributes, "material": self.material(name),
            "indices": self.accessor(indices, UINT16, "SCALAR", ELEMENTS)
        }

    def node(self, name, mesh, matrix, extras):
        node = {"name": name, "mesh": mesh, "extras": extras}
        matrix = np.round(Y_UP @ matrix @ np.linalg.inv(Y_UP), 6) + 0.0
        if np.array_equal(matrix[:3, :3], np.eye(3)):
            if matrix[:3, 3].any():
                node["translation"] = matrix[:3, 3].tolist()
        else:
            node["matrix"] = matrix.T.ravel().tolist()
        self.json["scenes"][0]["nodes"].append(len(self.json["nodes"]))
        self.json["nodes"].append(node)

    def add(self, mesh):
        """One glTF mesh per kind of surface (nodes carry the tag), placed everywhere."""
        kinds = {}
        for name, surface in mesh.part.surfaces.items():
            kind = (MATERIALS[name].surface, MATERIALS[name].lightmapped)
            kinds.setdefault(kind,
                             []).append(self.primitive(name, surface, mesh.light_uvs.get(name)))
        for (tag, lightmapped), primitives in kinds.items():
            name = mesh.name if len(kinds) == 1 else f"{mesh.name}_{tag}"
            self.json["meshes"].append({"name": name, "primitives": primitives})
            extras = {"surface": tag, "lightmapped": int(lightmapped)}
            for matrix in mesh.matrices:
                self.node(name, len(self.json["meshes"]) - 1, matrix, extras)

    def write(self, folder):
        self.json["buffers"] = [{"uri": "court.bin", "byteLength": len(self.bytes)}]
        (folder / "court.bin").write_bytes(self.bytes)
        text = json.dumps(self.json, indent=None, separators=(",", ":"))
        for key in self.json:
            text = text.replace(f'"{key}":[', f'\n"{key}":[\n')
        (folder / "court.gltf").write_text(text.replace("},{", "},\n{") + "\n")


def main(folder, side):
    writer = Writer()
    meshes = charts.lay_out(courtyard.courtyard(), side)
    for mesh in meshes:
        writer.add(mesh)
    writer.write(folder)
    triangles = [sum(len(s.triangles) for s in mesh.part.surfaces.values()) for mesh in meshes]
    drawn = sum(t * len(mesh.matrices) for t, mesh in zip(triangles, meshes))
    shared = sum(t * len(mesh.matrices) for t, mesh in zip(triangles, meshes)
                 if len(mesh.matrices) > 1)
    print(f"{drawn} triangles drawn, {shared} of them instances, {sum(triangles)} stored; "
          f"{len(writer.json['meshes'])} meshes, {len(writer.json['nodes'])} nodes, "
          f"{len(writer.json['materials'])} materials, {len(writer.bytes)} bytes")


if __name__ == "__main__":
    main(pathlib.Path(sys.argv[1]), int(sys.argv[2]))
