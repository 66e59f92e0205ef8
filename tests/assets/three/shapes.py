"""Shapes, pictures and a writer of glTF for make_models.py."""
import json
import math
import pathlib
import struct
import zlib

import numpy as np

# Letters of 5 x 7 dots, row by row.
LETTERS = {
    "A": "01110 10001 10001 11111 10001 10001 10001",
    "F": "11111 10000 10000 11110 10000 10000 10000",
    "G": "01110 10001 10000 10111 10001 10001 01110",
    "K": "10001 10010 10100 11000 10100 10010 10001",
    "L": "10000 10000 10000 10000 10000 10000 11111",
    "N": "10001 11001 11001 10101 10011 10011 10001",
    "O": "01110 10001 10001 10001 10001 10001 01110",
    "R": "11110 10001 10001 11110 10100 10010 10001",
    "S": "01111 10000 10000 01110 00001 00001 11110",
    "T": "11111 00100 00100 00100 00100 00100 00100",
    "U": "10001 10001 10001 10001 10001 10001 01110",
    "W": "10001 10001 10001 10101 10101 11011 10001",
    " ": "00000 00000 00000 00000 00000 00000 00000",
}


def glyph(text, w, h, ink=(0, 0, 0), paper=(255, 255, 255)):
    """A picture of w x h texels that a text fills."""
    rows = [" ".join(LETTERS[c].split()[y] for c in text) for y in range(7)]
    dots = np.pad(np.array([list(row.replace(" ", "0")) for row in rows]) == "1", 1)
    y, x = np.arange(h) * dots.shape[0] // h, np.arange(w) * dots.shape[1] // w
    return np.where(dots[y][:, x][..., None], np.uint8(ink), np.uint8(paper))


def png(texels):
    """A PNG file of 8 bits per channel with or without alpha."""
    texels = np.asarray(texels, np.uint8)
    height, width, channels = texels.shape
    rows = np.pad(texels.reshape(height, -1), ((0, 0), (1, 0))).tobytes()

    def chunk(kind, data):
        return (struct.pack(">I", len(data)) + kind + data +
                struct.pack(">I", zlib.crc32(kind + data)))

    head = struct.pack(">IIBBBBB", width, height, 8, 2 if channels == 3 else 6, 0, 0, 0)
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", zlib.compress(rows, 9)) +
            chunk(b"IEND", b""))


class Model:
    def __init__(self, name, says):
        self.name, self.says = name, says
        self.buf = bytearray()
        self.j = {"asset": {"version": "2.0", "generator": "make_models.py"}, "scene": 0,
                  "scenes": [{"nodes": []}],
                  "nodes": [], "meshes": [], "accessors": [], "bufferViews": [], "materials": []}
        self.used = set()
        self.views = {}  # the index of each view by its bytes, so that equal shapes are stored once

    def view(self, data):
        if data not in self.views:
            self.views[data] = len(self.j["bufferViews"])
            self.buf += bytes(-len(self.buf) % 4)
            self.j["bufferViews"].append(
                {"buffer": 0, "byteOffset": len(self.buf), "byteLength": len(data)})
            self.buf += data
        return self.views[data]

    def acc(self, a, bounds=False, normalized=False):
        a = np.ascontiguousarray(a)
        kind = {"f": 5126, "B": 5121, "H": 5123, "I": 5125, "b": 5120, "h": 5122}[a.dtype.char]
        shape = "SCALAR" if a.ndim == 1 else {2: "VEC2", 3: "VEC3", 4: "VEC4",
                                              16: "MAT4"}[a.shape[1]]
        d = {"bufferView": self.view(a.tobytes()), "componentType": kind, "count": len(a),
             "type": shape}
        if bounds:
            lo, hi = (a.min(0), a.max(0))
            d["min"], d["max"] = (np.atleast_1d(lo).tolist(), np.atleast_1d(hi).tolist())
        if normalized:
            d["normalized"] = True
        self.j["accessors"].append(d)
        return len(self.j["accessors"]) - 1

    def texture(self, picture, wrap=(10497, 10497), nearest=False):
        for k in ("images", "textures", "samplers"):
            self.j.setdefault(k, [])
        self.j["images"].append({"bufferView": self.view(png(picture)), "mimeType": "image/png"})
        self.j["samplers"].append({"wrapS": wrap[0], "wrapT": wrap[1],
                                   "magFilter": 9728 if nearest else 9729,
                                   "minFilter": 9728 if nearest else 9987})
        self.j["textures"].append({"source": len(self.j["images"]) - 1,
                                   "sampler": len(self.j["samplers"]) - 1})
        return len(self.j["textures"]) - 1

    def material(self, colour=(1, 1, 1, 1), metal=0.0, rough=1.0, ext=None, pbr=None, **more):
        m = {"pbrMetallicRoughness": {"baseColorFactor": list(map(float, colour)),
                                      "metallicFactor": metal,
                                      "roughnessFactor": rough, **(pbr or {})}, **more}
        if ext:
            m["extensions"] = ext
            self.used |= set(ext)
        self.j["materials"].append(m)
        return len(self.j["materials"]) - 1

    def textured(self, texture, **more):
        return self.material(pbr={"baseColorTexture": {"index": texture}}, **more)

    def prim(self, geo, material=None, extra=None, **more):
        at = {"POSITION": self.acc(geo["p"].astype("f4"), bounds=True)}
        for key, name in (("n", "NORMAL"), ("uv", "TEXCOORD_0"), ("uv1", "TEXCOORD_1"),
                          ("t", "TANGENT")):
            if key in geo:
                at[name] = self.acc(geo[key].astype("f4"))
        at.update(extra or {})
        d = {"attributes": at, **more}
        if "i" in geo:
            d["indices"] = self.acc(geo["i"].astype("u2").ravel())
        if material is not None:
            d["material"] = material
        return d

    def mesh(self, *prims, **more):
        self.j["meshes"].append({"primitives": list(prims), **more})
        return len(self.j["meshes"]) - 1

    def node(self, root=True, **d):
        self.j["nodes"].append(d)
        if root:
            self.j["scenes"][0]["nodes"].append(len(self.j["nodes"]) - 1)
        return len(self.j["nodes"]) - 1

    def put(self, geo, material, at=(0, 0, 0), **node):
        return self.node(mesh=self.mesh(self.prim(geo, material)), translation=list(map(float, at)),
                         **node)

    def save(self, folder, pose, fov, required=(), times=()):
        self.used |= set(required)
        if self.used:
            self.j["extensionsUsed"] = sorted(self.used)
        if required:
            self.j["extensionsRequired"] = sorted(required)
        j = {k: v for k, v in self.j.items() if v != []}
        j["buffers"] = [{"byteLength": len(self.buf)}]
        text = json.dumps(j, separators=(",", ":")).encode()
        text += b" " * (-len(text) % 4)
        data = bytes(self.buf) + bytes(-len(self.buf) % 4)
        file = pathlib.Path(folder) / self.name
        file.with_suffix(".glb").write_bytes(
            struct.pack("<4sIIII", b"glTF", 2, 28 + len(text) + len(data), len(text), 0x4E4F534A) +
            text + struct.pack("<II", len(data), 0x004E4942) + data)
        line = " ".join("%.9g" % v for v in [*pose, fov])
        views = [line] + [f"{line} {t}" for t in times]
        file.with_suffix(".pose").write_text("\n".join(views) + "\n")
        file.with_suffix(".txt").write_text(self.says + "\n")


def look(eye, at):
    """Pose of a camera at eye that looks at a point, +Y up."""
    z = np.subtract(eye, at).astype(float)
    z /= np.linalg.norm(z)
    x = np.cross((0, 1, 0), z)
    x /= np.linalg.norm(x)
    m = np.array([x, np.cross(z, x), z]).T
    w = math.sqrt(max(0, 1 + m[0, 0] + m[1, 1] + m[2, 2])) / 2
    return list(eye) + [(m[2, 1] - m[1, 2]) / (4 * w), (m[0, 2] - m[2, 0]) / (4 * w),
                        (m[1, 0] - m[0, 1]) / (4 * w), w]


def quad(w=1.0, h=1.0, s=1.0, flip=False):
    g = {"p": np.array([[-w, -h, 0], [w, -h, 0], [w, h, 0], [-w, h, 0]]) / 2,
         "n": np.tile([0, 0, 1.0], (4, 1)),
         "uv": np.array([[0, s], [s, s], [s, 0], [0, 0]], float),
         "i": np.array([[0, 1, 2], [0, 2, 3]])}
    if flip:
        g["uv"] = g["uv"][:, ::1] * [-1, 1] + [s, 0]
    return g


def sphere(r=0.45, n=48, m=32):
    u, v = np.meshgrid(np.linspace(0, 1, n + 1), np.linspace(0, 1, m + 1))
    a, b = u.ravel() * 2 * np.pi, v.ravel() * np.pi
    d = np.stack([np.sin(b) * np.cos(a), np.cos(b), -np.sin(b) * np.sin(a)], 1)
    k = (np.arange(m)[:, None] * (n + 1) + np.arange(n)[None]).ravel()
    i = np.concatenate([np.stack([k, k + n + 1, k + 1], 1),
                        np.stack([k + 1, k + n + 1, k + n + 2], 1)])
    return {"p": d * r, "n": d, "uv": np.stack([u.ravel(), v.ravel()], 1), "i": i}


def box(w, h, d):
    p, n, uv, i = [], [], [], []
    for axis in range(3):
        for sign in (1, -1):
            normal, side = np.zeros(3), np.zeros(3)
            normal[axis] = sign
            side[(axis + 1) % 3] = 1
            up = np.cross(normal, side)
            for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1)):
                p.append((normal + side * x + up * y) * [w / 2, h / 2, d / 2])
                n.append(normal)
                uv.append([(x + 1) / 2, (1 - y) / 2])
            k = len(p) - 4
            i += [[k, k + 1, k + 2], [k, k + 2, k + 3]]
    return {"p": np.array(p), "n": np.array(n), "uv": np.array(uv), "i": np.array(i)}


def turn(geo, angle, axis=1):
    c, s = math.cos(angle), math.sin(angle)
    r = np.eye(3)
    a, b = (axis + 1) % 3, (axis + 2) % 3
    r[a, a], r[a, b], r[b, a], r[b, b] = c, -s, s, c
    return {**geo, "p": geo["p"] @ r.T, "n": geo["n"] @ r.T}


def checker(n=8, size=256, a=(230, 230, 230), b=(40, 60, 110)):
    y, x = np.indices((size, size)) * n // size
    return np.where(((x + y) % 2)[..., None], np.uint8(a), np.uint8(b)).astype(np.uint8)
