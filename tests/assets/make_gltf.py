#!/usr/bin/env python3
"""Writes the small glTF models that test_gltf.c reads: one for each feature of the format.

Usage: make_gltf.py FOLDER

The numbers that the test expects stand in the test; they follow from the numbers here by hand.
pack_gltf.mjs packs plain.gltf.
"""
import base64
import json
import pathlib
import struct
import sys
import zlib

BYTE, UBYTE, SHORT, USHORT, UINT, FLOAT = 5120, 5121, 5122, 5123, 5125, 5126
CODES = {BYTE: "b", UBYTE: "B", SHORT: "h", USHORT: "H", UINT: "I", FLOAT: "f"}
WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT4": 16}
TRIANGLE = [0, 0, 0, 1, 0, 0, 0, 1, 0]
UP = [0, 0, 1] * 3
CORNERS = [0, 0, 1, 0, 0, 1]


def png(width, height, texels):
    """An RGB or RGBA picture of 8 bits."""
    channels = len(texels[0])
    rows = b"".join(b"\0" + bytes(c for t in texels[y * width:(y + 1) * width] for c in t)
                    for y in range(height))

    def chunk(kind, data):
        return (struct.pack(">I", len(data)) + kind + data +
                struct.pack(">I", zlib.crc32(kind + data)))

    head = struct.pack(">IIBBBBB", width, height, 8, 2 if channels == 3 else 6, 0, 0, 0)
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", zlib.compress(rows, 9)) +
            chunk(b"IEND", b""))


class Model:

    def __init__(self):
        self.json = {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": []}]}
        self.bytes = bytearray()

    def add(self, table, entry):
        self.json.setdefault(table, []).append(entry)
        return len(self.json[table]) - 1

    def view(self, data, **more):
        self.bytes += bytes(-len(self.bytes) % 4)
        offset = len(self.bytes)
        self.bytes += data
        return self.add("bufferViews",
                        {"buffer": 0, "byteOffset": offset, "byteLength": len(data), **more})

    def pack(self, values, component):
        return struct.pack(f"<{len(values)}{CODES[component]}", *values)

    def accessor(self, values, shape="VEC3", component=FLOAT, **more):
        view = self.view(self.pack(values, component))
        return self.add("accessors", {"bufferView": view, "componentType": component,
                                      "count": len(values) // WIDTHS[shape], "type": shape, **more})

    def texture(self, picture, wrap=None, **transform):
        """A texture of its own, as a material uses it."""
        image = self.add("images", {"bufferView": self.view(picture), "mimeType": "image/png"})
        texture = {"source": image}
        if wrap:
            texture["sampler"] = self.add("samplers", {"wrapS": wrap[0], "wrapT": wrap[1]})
        use = {"index": self.add("textures", texture)}
        if transform:
            use["extensions"] = {"KHR_texture_transform": transform}
        return use

    def mesh(self, attributes, **more):
        name = f"mesh {len(self.json.get('meshes', []))}"
        return self.add("meshes",
                        {"name": name, "primitives": [{"attributes": attributes, **more}]})

    def triangle(self, **more):
        return self.mesh({"POSITION": self.accessor(TRIANGLE), "NORMAL": self.accessor(UP),
                          "TEXCOORD_0": self.accessor(CORNERS, "VEC2")}, **more)

    def node(self, name, mesh=None, root=True, **more):
        index = self.add("nodes", {"name": name, **({} if mesh is None else {"mesh": mesh}), **more})
        if root:
            self.json["scenes"][0]["nodes"].append(index)
        return index

    def save(self, name):
        uri = "data:application/octet-stream;base64," + base64.b64encode(self.bytes).decode()
        self.json["buffers"] = [{"byteLength": len(self.bytes), "uri": uri}]
        text = json.dumps(self.json, indent=1)
        (pathlib.Path(sys.argv[1]) / f"{name}.gltf").write_text(text + "\n")


def strips():
    """Five corners of a strip, and the same five of a fan; no normals, no indices in the fan."""
    m = Model()
    five = [0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 2, 0]
    strip = m.mesh({"POSITION": m.accessor(five)}, mode=5,
                   indices=m.accessor([0, 1, 2, 3, 4], "SCALAR", USHORT))
    m.node("strip", strip)
    m.node("fan", m.mesh({"POSITION": m.accessor([0, 0, 0, 2, 0, 0, 2, 1, 0, 1, 2, 0, 0, 2, 0])},
                         mode=6))
    m.node("lines", m.mesh({"POSITION": m.accessor(five)}, mode=3))
    m.node("points", m.mesh({"POSITION": m.accessor(five)}, mode=0))
    m.save("strips")


def ridge():
    """Two triangles that share an edge, without normals, a point, and a surface of old files."""
    m = Model()
    m.add("materials", {"name": "old", "extensions": {"KHR_materials_pbrSpecularGlossiness": {}}})
    four = [0, 0, 0, 4, 0, 0, 0, 1, 1, 0, -2, 0]
    m.node("ridge", m.mesh({"POSITION": m.accessor(four)}, material=0,
                           indices=m.accessor([0, 1, 2, 1, 0, 3], "SCALAR", UBYTE)))
    m.node("point", m.mesh({"POSITION": m.accessor([1, 2, 3])}, mode=0))
    m.save("ridge")


def sparse():
    """Vertex 2 is moved to (5, 6, 7); a second mesh has no values but the listed ones."""
    m = Model()
    where = m.view(m.pack([2], USHORT))
    what = m.view(m.pack([5.0, 6.0, 7.0], FLOAT))
    listed = {"count": 1, "indices": {"bufferView": where, "componentType": USHORT},
              "values": {"bufferView": what}}
    moved = m.accessor(TRIANGLE)
    m.json["accessors"][moved]["sparse"] = listed
    m.node("moved", m.mesh({"POSITION": moved}))
    alone = m.add("accessors", {"componentType": FLOAT, "count": 3, "type": "VEC3",
                                "sparse": listed})
    m.node("alone", m.mesh({"POSITION": alone}))
    m.save("sparse")


def quantized():
    """Positions of 16 bits, normals of 8 bits with a gap after each, coordinates of 16 bits."""
    m = Model()
    m.json["extensionsUsed"] = m.json["extensionsRequired"] = ["KHR_mesh_quantization"]
    positions = m.accessor([0, 0, 0, 32767, 0, 0, 0, -32767, 0], "VEC3", SHORT, normalized=True)
    m.json["bufferViews"][-1]["byteStride"] = 6
    view = m.view(m.pack([0, 0, 127, 99] * 3, BYTE), byteStride=4)
    normals = m.add("accessors", {"bufferView": view, "componentType": BYTE, "count": 3,
                                  "type": "VEC3", "normalized": True})
    whole = m.accessor([0, 0, 3, 0, 0, 2], "VEC2", USHORT)
    picture = m.texture(png(1, 1, [(1, 2, 3)]))
    m.add("materials", {"pbrMetallicRoughness": {"baseColorTexture": picture}})
    m.node("small", m.mesh({"POSITION": positions, "NORMAL": normals, "TEXCOORD_0": whole},
                           material=0), scale=[2, 2, 2])
    m.save("quantized")


def colours():
    m = Model()
    m.add("materials", {"name": "cut", "alphaMode": "MASK"})
    base = {"POSITION": m.accessor(TRIANGLE), "NORMAL": m.accessor(UP)}
    three = m.accessor([1, .5, 0, 0, 2, 0, 0, 0, .25])
    m.node("three", m.mesh({**base, "COLOR_0": three}))
    four = m.accessor([255, 51, 0, 0, 0, 0, 255, 102, 255, 0, 0, 255], "VEC4", UBYTE,
                      normalized=True)
    m.node("four", m.mesh({**base, "COLOR_0": four}, material=0))
    m.add("materials", {"name": "blended", "alphaMode": "BLEND"})
    m.node("mixed", m.mesh({**base, "COLOR_0": four}, material=1))
    m.node("solid", m.mesh({**base, "COLOR_0": three}, material=1))
    m.node("whole", m.mesh({**base, "COLOR_0": four}))
    m.save("colours")


def materials():
    m = Model()
    one = png(1, 1, [(10, 20, 30)])
    clear = png(1, 1, [(10, 20, 30, 100)])

    def put(name, **material):
        m.node(name, m.triangle(material=m.add("materials", {"name": name, **material})))

    def ext(name, **values):
        return {"extensions": {f"KHR_materials_{name}": values}}

    m.node("none", m.triangle())
    put("empty")
    put("metal", pbrMetallicRoughness={"metallicFactor": .75, "roughnessFactor": .25,
                                       "metallicRoughnessTexture": m.texture(one)})
    put("unlit", **ext("unlit"))
    put("glow", emissiveFactor=[.5, .25, 0], emissiveTexture=m.texture(one),
        **ext("emissive_strength", emissiveStrength=8))
    put("rough normals", normalTexture={**m.texture(one), "scale": .5})
    put("shaded", occlusionTexture={**m.texture(one), "strength": .25})
    put("specular", **ext("specular", specularFactor=.5, specularColorFactor=[2, 1, 50]))
    put("ior", **ext("ior", ior=2))
    put("cloth", **ext("sheen", sheenColorFactor=[.5, .25, 1], sheenRoughnessFactor=.75))
    put("coat", **ext("clearcoat", clearcoatFactor=.5, clearcoatRoughnessFactor=.125))
    put("pane", pbrMetallicRoughness={"baseColorFactor": [0, 1, 0, 1], "metallicFactor": 0},
        extensions={"KHR_materials_transmission": {"transmissionFactor": .5},
                    "KHR_materials_ior": {"ior": 1.25}})
    put("blend", alphaMode="BLEND", doubleSided=True,
        pbrMetallicRoughness={"baseColorFactor": [1, 1, 1, .5]})
    put("blend picture", alphaMode="BLEND",
        pbrMetallicRoughness={"baseColorTexture": m.texture(clear)})
    put("blend opaque", alphaMode="BLEND",
        pbrMetallicRoughness={"baseColorTexture": m.texture(one)})
    put("glossy", **ext("pbrSpecularGlossiness", diffuseFactor=[.5, .25, 0, 1],
                        specularFactor=[.5, .25, .125], glossinessFactor=.75))
    put("mirrored", pbrMetallicRoughness={"baseColorTexture": m.texture(one, (33648, 33071))})
    m.save("materials")


def glossy():
    """Specular-glossiness pictures: alone, beside metal and roughness, and one that is missing."""
    m = Model()
    one = png(1, 1, [(10, 20, 30)])
    gloss = {"index": m.texture(png(2, 1, [(255, 0, 255, 255), (0, 0, 255, 51)]))["index"]}
    lost = {"index": m.add("textures", {"source": m.add("images", {"uri": "lost.png"})})}
    rough = {"metallicFactor": .25, "metallicRoughnessTexture": m.texture(one)}
    for name, picture, metallic in (("alone", gloss, {}), ("beside", gloss, rough),
                                    ("lost", lost, {})):
        extension = {"diffuseFactor": [.5, .25, 0, 1], "specularFactor": [1, 1, .5],
                     "glossinessFactor": .5, "specularGlossinessTexture": picture}
        m.node(name, m.triangle(material=m.add("materials", {
            "name": name, "pbrMetallicRoughness": metallic,
            "extensions": {"KHR_materials_pbrSpecularGlossiness": extension}})))
    m.save("glossy")


def coordinates():
    """Colour on set 1 and turned, emission and occlusion on set 0, and a normal map that fits none."""
    m = Model()
    one = png(1, 1, [(10, 20, 30)])
    turned = m.texture(one, offset=[.5, .25], rotation=1.5707963267948966, scale=[2, 4], texCoord=1)
    m.add("materials", {"name": "many", "emissiveFactor": [1, 1, 1],
                        "pbrMetallicRoughness": {"baseColorTexture": turned},
                        "emissiveTexture": m.texture(one), "occlusionTexture": m.texture(one),
                        "normalTexture": {**m.texture(one), "texCoord": 2}})
    at = {"POSITION": m.accessor(TRIANGLE), "NORMAL": m.accessor(UP),
          "TEXCOORD_0": m.accessor([0, 0, .5, 0, 0, .5], "VEC2"),
          "TEXCOORD_1": m.accessor(CORNERS, "VEC2"), "TEXCOORD_2": m.accessor(CORNERS, "VEC2")}
    m.node("many", m.mesh(at, material=0))
    m.save("coordinates")


def instancing():
    m = Model()
    m.json["extensionsUsed"] = m.json["extensionsRequired"] = ["EXT_mesh_gpu_instancing"]
    half = .7071067811865476
    attributes = {"TRANSLATION": m.accessor([1, 0, 0, 0, 2, 0, 0, 0, 3]),
                  "ROTATION": m.accessor([0, 0, 0, 1, 0, 0, half, half, 0, 0, 0, 1], "VEC4"),
                  "SCALE": m.accessor([1, 1, 1, 1, 1, 1, 2, 2, 2])}
    m.node("many", m.triangle(), translation=[10, 0, 0],
           extensions={"EXT_mesh_gpu_instancing": {"attributes": attributes}})
    hidden = m.triangle()
    m.node("hidden", hidden, extensions={"KHR_node_visibility": {"visible": False}})
    m.save("instancing")


def shapes():
    """A skin of two joints, and a mesh with a morph target that two nodes weigh differently."""
    m = Model()
    base = {"POSITION": m.accessor([0, 0, 0, 1, 0, 0, 0, 1, 0]), "NORMAL": m.accessor(UP)}
    skinned = {**base, "JOINTS_0": m.accessor([0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0], "VEC4", UBYTE),
               "WEIGHTS_0": m.accessor([1, 0, 0, 0, 1, 0, 0, 0, .5, .5, 0, 0], "VEC4")}
    root = m.node("root", translation=[0, 0, 5], children=[])
    arm = m.node("arm", root=False, translation=[0, 10, 0])
    m.json["nodes"][root]["children"] = [arm]
    binds = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1] * 2
    binds[28:31] = [0, -4, 0]  # The arm was bound at (0, 4, 0).
    m.add("skins", {"joints": [root, arm], "inverseBindMatrices": m.accessor(binds, "MAT4")})
    m.node("skinned", m.mesh(skinned), skin=0, translation=[99, 99, 99])
    face = m.mesh(base, targets=[{"POSITION": m.accessor([0, 0, 0, 0, 0, 2, 0, 0, 4])}])
    m.json["meshes"][face]["weights"] = [.5]
    m.node("half", face)
    m.node("whole", face, weights=[1])
    m.node("rest", face, weights=[0])
    m.save("shapes")


def lamps():
    """One light that two nodes use."""
    m = Model()
    m.node("floor", m.triangle())
    m.json["extensions"] = {"KHR_lights_punctual": {"lights": [{"type": "point", "intensity": 7}]}}
    for name, x in (("left", -1), ("right", 1)):
        m.node(name, translation=[x, 0, 0],
               extensions={"KHR_lights_punctual": {"light": 0}})
    m.save("lamps")


def losses():
    """Features that Diptych does not draw, some of them only used and not listed."""
    m = Model()
    m.json["extensionsUsed"] = ["KHR_materials_anisotropy", "KHR_materials_variants", "ACME_smell",
                                "EXT_mesh_features"]
    m.json["scenes"].append({"nodes": []})
    picture = m.texture(png(1, 1, [(10, 20, 30)]))
    one = {**picture, "extensions": {"ACME_nested": {}}, "extras": {"extensions": {"ACME_own": 1}}}
    coat = {"clearcoatFactor": 1, "clearcoatTexture": one}
    for name in ("first", "second"):
        m.node(name, m.triangle(material=m.add("materials", {"name": name, "extensions": {
            "KHR_materials_iridescence": {}, "KHR_materials_clearcoat": coat,
            "KHR_materials_sheen": {"sheenColorTexture": one}}})))
    primitive = m.json["meshes"][0]["primitives"][0]
    joints = m.accessor([0] * 12, "VEC4", UBYTE)
    primitive["attributes"]["JOINTS_1"] = joints
    primitive["targets"] = [{"TEXCOORD_0": m.accessor(CORNERS, "VEC2")}]
    bumps = m.add("materials", {"name": "bumps", "normalTexture": {**picture, "scale": .5}})
    for name in ("third", "fourth"):
        m.node(name, m.triangle(material=bumps), extras={"surface": "solid"})
    skinned = m.mesh({"POSITION": m.accessor(TRIANGLE), "NORMAL": m.accessor(UP),
                      "JOINTS_0": joints, "WEIGHTS_0": m.accessor([1, 0, 0, 0] * 3, "VEC4")})
    m.add("skins", {"joints": [0]})
    places = {"TRANSLATION": m.accessor([1, 0, 0, 0, 2, 0])}
    for name in ("fifth", "sixth"):
        m.node(name, skinned, skin=0,
               extensions={"EXT_mesh_gpu_instancing": {"attributes": places}})
    samplers = [{"input": m.accessor([0, 1], "SCALAR"), "output": m.accessor([0, 1], "SCALAR")}]
    pointer = {"pointer": "/materials/0/extensions/KHR_materials_clearcoat/clearcoatFactor"}
    channel = {"sampler": 0, "target": {"path": "pointer",
                                        "extensions": {"KHR_animation_pointer": pointer}}}
    m.add("animations", {"samplers": samplers, "channels": [channel, channel]})
    m.save("losses")


def plain():
    """A hill of 5x5 vertices with a picture, to be packed."""
    m = Model()
    grid = [(x, y) for y in range(5) for x in range(5)]
    height = [[(2 - abs(x - 2)) * (2 - abs(y - 2)) / 8 for x in range(5)] for y in range(5)]
    indices = []
    for y in range(4):
        for x in range(4):
            k = 5 * y + x
            indices += [k, k + 1, k + 6, k, k + 6, k + 5]
    at = {"POSITION": m.accessor([c for x, y in grid for c in (x / 4, height[y][x], -y / 4)]),
          "NORMAL": m.accessor([0, 1, 0] * 25),
          "TEXCOORD_0": m.accessor([c for x, y in grid for c in (x / 4, y / 4)], "VEC2"),
          "COLOR_0": m.accessor([255, 128, 64, 255] * 25, "VEC4", UBYTE, normalized=True)}
    texels = [(16 * x, 16 * y, 255 - 16 * x, 255 - 8 * y) for y in range(8) for x in range(8)]
    m.add("materials", {"name": "hill", "pbrMetallicRoughness":
                        {"baseColorTexture": m.texture(png(8, 8, texels)), "metallicFactor": 0}})
    for accessor in m.json["accessors"][:1]:
        accessor["min"], accessor["max"] = [0, 0, -1], [1, .5, 0]
    m.node("hill", m.mesh(at, material=0, indices=m.accessor(indices, "SCALAR", USHORT)))
    m.save("plain")


for make in (strips, ridge, sparse, quantized, colours, materials, glossy, coordinates, instancing,
             shapes, lamps, losses, plain):
    make()
