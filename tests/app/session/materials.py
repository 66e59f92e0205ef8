# Writes one scene twice: as glTF with tags (scene.gltf), and as X without tags (scene.x). The scene
# has a lit wall, a wall with a light map, a clipped fence, glass, water and a sky.
# Usage: materials.py FOLDER
import base64, json, os, struct, sys, zlib

folder = sys.argv[1]


def write_png(name, size, texel):
    rows = b"".join(b"\0" + b"".join(bytes(texel(x, y)) for x in range(size)) for y in range(size))
    def chunk(kind, body):
        return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))
    with open(os.path.join(folder, name), "wb") as out:
        out.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", size, size, 8, 6, 0, 0, 0)) +
                  chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))


write_png("brick.png", 16, lambda x, y: (40 + 10 * x, 200 - 9 * y, 60 + (x ^ y) * 9, 255))
write_png("light.png", 16, lambda x, y: (30 + 13 * y, 90 + 8 * x, 128, 255))
write_png("fence.png", 16, lambda x, y: (180, 120, 60, 255 if x % 4 < 2 or y % 8 < 2 else 0))
write_png("clouds.png", 16, lambda x, y: (128 + 5 * x, 128 - 5 * y, 160 + 6 * ((x * y) % 16), 255))

# Each part: name, colour texture, tags, corners and the normal. Corners go counterclockwise.
parts = [
    ("Plain wall", "brick.png", {"surface": "solid"}, [(-6, 0, -4), (-2, 0, -4), (-2, 3, -4), (-6, 3, -4)], (0, 0, 1)),
    ("Lit wall", "brick.png", {"lightmapped": 1}, [(-2, 0, -4), (2, 0, -4), (2, 3, -4), (-2, 3, -4)], (0, 0, 1)),
    ("Fence", "fence.png", {"surface": "mask"}, [(2, 0, -4), (6, 0, -4), (6, 3, -4), (2, 3, -4)], (0, 0, 1)),
    ("Glass_1", "brick.png", {"surface": "glass"}, [(-1, 0, -2), (0, 0, -2), (0, 1, -2), (-1, 1, -2)], (0, 0, 1)),
    ("Pool é", "brick.png", {"surface": "water"}, [(-6, 0, 4), (6, 0, 4), (6, 0, -4), (-6, 0, -4)], (0, 1, 0)),
    ("Himmel", "clouds.png", {"surface": "sky"}, [(-32, 16, -32), (32, 16, -32), (32, 16, 32), (-32, 16, 32)], (0, -1, 0)),
]
uvs = [(0.0, 1.0), (1.0, 1.0), (1.0, 0.0), (0.0, 0.0)]  # v = 0 is the upper edge, in both formats
light_uvs = [(0.25, 0.75), (0.75, 0.75), (0.75, 0.25), (0.25, 0.25)]

# --- glTF
data = b""
gltf = {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": []}], "nodes": [], "meshes": [],
        "materials": [], "textures": [], "images": [], "samplers": [{}], "accessors": [], "bufferViews": []}


def accessor(values, kind, component, layout):
    global data
    body = b"".join(struct.pack(layout, *v) for v in values)
    gltf["bufferViews"].append({"buffer": 0, "byteOffset": len(data), "byteLength": len(body)})
    entry = {"bufferView": len(gltf["bufferViews"]) - 1, "componentType": component, "count": len(values), "type": kind}
    if kind == "VEC3":
        entry["min"] = [min(v[i] for v in values) for i in range(3)]
        entry["max"] = [max(v[i] for v in values) for i in range(3)]
    gltf["accessors"].append(entry)
    data += body
    return len(gltf["accessors"]) - 1


def texture(name):
    gltf["images"].append({"uri": name})
    gltf["textures"].append({"source": len(gltf["images"]) - 1, "sampler": 0})
    return len(gltf["textures"]) - 1


for name, picture, tags, corners, normal in parts:
    material = {"name": name, "doubleSided": True,
                "pbrMetallicRoughness": {"baseColorTexture": {"index": texture(picture)}}}
    if "lightmapped" in tags:
        material["occlusionTexture"] = {"index": texture("light.png"), "texCoord": 1}
    gltf["materials"].append(material)
    gltf["meshes"].append({"primitives": [{"material": len(gltf["materials"]) - 1, "attributes": {
        "POSITION": accessor(corners, "VEC3", 5126, "<3f"), "NORMAL": accessor([normal] * 4, "VEC3", 5126, "<3f"),
        "TEXCOORD_0": accessor(uvs, "VEC2", 5126, "<2f"), "TEXCOORD_1": accessor(light_uvs, "VEC2", 5126, "<2f")},
        "indices": accessor([(0,), (1,), (2,), (0,), (2,), (3,)], "SCALAR", 5125, "<I")}]})
    gltf["nodes"].append({"name": name, "mesh": len(gltf["meshes"]) - 1, "extras": tags})
    gltf["scenes"][0]["nodes"].append(len(gltf["nodes"]) - 1)
gltf["buffers"] = [{"byteLength": len(data),
                    "uri": "data:application/octet-stream;base64," + base64.b64encode(data).decode()}]
with open(os.path.join(folder, "scene.gltf"), "w") as out:
    json.dump(gltf, out)

# --- X: left-handed, so z is negated and triangles go the other way around
with open(os.path.join(folder, "scene.x"), "w") as out:
    out.write("xof 0303txt 0032\n")
    for index, (name, picture, tags, corners, normal) in enumerate(parts):
        vertices = "".join("%g;%g;%g;%s\n" % (x, y, -z, ";" if i == 3 else ",")
                           for i, (x, y, z) in enumerate(corners))
        normals = "".join("%g;%g;%g;%s\n" % (*normal[:2], -normal[2], ";" if i == 3 else ",") for i in range(4))
        faces = "2;\n3;2,1,0;,\n3;3,2,0;;\n"
        out.write("Frame part%d {\n Mesh mesh%d {\n  4;\n%s%s" % (index, index, vertices, faces))
        out.write("  MeshNormals {\n   4;\n%s%s  }\n" % (normals, faces))
        for pairs in (uvs, light_uvs):
            out.write("  MeshTextureCoords {\n   4;\n%s  }\n" % "".join(
                "%g;%g;%s\n" % (u, v, ";" if i == 3 else ",") for i, (u, v) in enumerate(pairs)))
        out.write("  MeshMaterialList {\n   1;\n   2;\n   0,\n   0;;\n   Material %s {\n" % name.replace(" ", "_"))
        out.write("    1.0;1.0;1.0;1.0;;\n    0.0;\n    0.0;0.0;0.0;;\n    0.0;0.0;0.0;;\n")
        out.write('    TextureFilename {\n     "%s";\n    }\n   }\n  }\n }\n}\n' % picture)
