# Checks the camera paths that Diptych makes of a glTF file's cameras. The expected poses are computed
# here in double precision, from the formulas of the glTF 2.0 specification (3.5 Geometry, 3.10
# Cameras, 3.11 and appendix C Animations), with 4x4 matrices and with no code of Diptych.
# Usage: model_cameras.py DIPTYCH FOLDER SEED
import json, math, os, random, struct, subprocess, sys

diptych, folder, seed = sys.argv[1], sys.argv[2], int(sys.argv[3])
rng = random.Random(seed)
DURATION = 2.5
FPS = 30


def unit(q):
    length = math.sqrt(sum(x * x for x in q))
    return [x / length for x in q]


def f32(x):
    return struct.unpack("<f", struct.pack("<f", x))[0]


# --- the evaluation, from the specification

def hermite(u, td, value, out_tangent, next_value, in_tangent):
    return [(2 * u**3 - 3 * u**2 + 1) * v + td * (u**3 - 2 * u**2 + u) * b +
            (-2 * u**3 + 3 * u**2) * n + td * (u**3 - u**2) * a
            for v, b, n, a in zip(value, out_tangent, next_value, in_tangent)]


def slerp(a, b, u):
    d = sum(x * y for x, y in zip(a, b))
    sign = -1 if d < 0 else 1
    d = min(abs(d), 1.0)
    if d > 1 - 1e-12:
        return [x + u * (sign * y - x) for x, y in zip(a, b)]
    angle = math.acos(d)
    return [(math.sin((1 - u) * angle) * x + sign * math.sin(u * angle) * y) / math.sin(angle)
            for x, y in zip(a, b)]


def evaluate(track, t):
    times, values, mode = track["times"], track["values"], track["mode"]
    key = (lambda i: values[i][1]) if mode == "CUBICSPLINE" else (lambda i: values[i])
    if t <= times[0]:
        return key(0)
    if t >= times[-1]:
        return key(len(times) - 1)
    i = max(k for k in range(len(times)) if times[k] <= t + 1e-6)
    td = times[i + 1] - times[i]
    u = max((t - times[i]) / td, 0.0)
    if mode == "STEP":
        return key(i)
    if mode == "LINEAR":
        if track["path"] == "rotation":
            return slerp(key(i), key(i + 1), u)
        return [x + u * (y - x) for x, y in zip(key(i), key(i + 1))]
    return hermite(u, td, values[i][1], values[i][2], values[i + 1][1], values[i + 1][0])


def matrix_of(t, r, s):
    x, y, z, w = unit(r)
    m = [[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
         [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
         [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]]
    return [[m[i][j] * s[j] for j in range(3)] + [t[i]] for i in range(3)] + [[0, 0, 0, 1]]


def times_matrix(a, b):
    return [[sum(a[i][k] * b[k][j] for k in range(4)) for j in range(4)] for i in range(4)]


def world_of(scene, node, animation, t):
    n = scene["nodes"][node]
    if "matrix" in n:
        local = [[n["matrix"][4 * j + i] for j in range(4)] for i in range(4)]
    else:
        trs = {"translation": n.get("translation", [0, 0, 0]), "rotation": n.get("rotation", [0, 0, 0, 1]),
               "scale": n.get("scale", [1, 1, 1])}
        for track in animation:
            if track["node"] == node:
                trs[track["path"]] = evaluate(track, t)
        local = matrix_of(trs["translation"], trs["rotation"], trs["scale"])
    parent = scene["parents"].get(node)
    return local if parent is None else times_matrix(world_of(scene, parent, animation, t), local)


# Where the camera is, where it looks and which way is up: the directions as unit vectors.
def view_of(world):
    position = [world[i][3] for i in range(3)]
    look = unit([-world[i][2] for i in range(3)])
    up = [world[i][1] for i in range(3)]
    along = sum(a * b for a, b in zip(up, look))
    return position, look, unit([a - along * b for a, b in zip(up, look)])


def view_of_pose(pose):
    x, y, z, w = pose["orientation"]
    look = [-2 * (x * z + y * w), -2 * (y * z - x * w), -(1 - 2 * (x * x + y * y))]
    return pose["position"], look, [2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w)]


# --- the file

data = b""
gltf = {"asset": {"version": "2.0"}, "scene": 0, "accessors": [], "bufferViews": [], "nodes": [],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}], "animations": [],
        "cameras": [{"type": "perspective", "perspective": {"yfov": 0.7, "aspectRatio": 1.5, "znear": 0.1}},
                    {"type": "orthographic", "orthographic": {"xmag": 1, "ymag": 1, "zfar": 9, "znear": 0.1}},
                    {"type": "perspective", "name": "Lens", "perspective": {"yfov": 1.2, "znear": 0.1}},
                    {"type": "perspective", "perspective": {"yfov": 3.1, "znear": 0.1}}]}


def accessor(rows, kind):
    global data
    body = b"".join(struct.pack("<%df" % len(r), *r) for r in rows)
    gltf["bufferViews"].append({"buffer": 0, "byteOffset": len(data), "byteLength": len(body)})
    entry = {"bufferView": len(gltf["bufferViews"]) - 1, "componentType": 5126, "count": len(rows), "type": kind}
    if not gltf["accessors"] or kind == "SCALAR":
        entry["min"] = [min(r[i] for r in rows) for i in range(len(rows[0]))]
        entry["max"] = [max(r[i] for r in rows) for i in range(len(rows[0]))]
    gltf["accessors"].append(entry)
    data += body
    return len(gltf["accessors"]) - 1


accessor([(-1, -1, 0), (1, -1, 0), (0, 1, 0)], "VEC3")


def quaternion():
    return [f32(x) for x in unit([rng.gauss(0, 1) for _ in range(4)])]


def vector(scale):
    return [f32(rng.uniform(-scale, scale)) for _ in range(3)]


def sizes():
    return [f32(rng.uniform(0.5, 2)) for _ in range(3)]


# STEP keys lie on frames, since a path cannot jump; other keys lie anywhere.
def random_track(node, path, mode):
    count = rng.randint(2, 6)
    if mode == "STEP":
        times = sorted(rng.sample(range(1, 74), count - 1)) + [75]
        times = [f32(k / FPS) for k in times]
    else:
        times = sorted(f32(rng.uniform(0.1, DURATION - 0.1)) for _ in range(count - 1)) + [DURATION]
    make = {"rotation": quaternion, "translation": lambda: vector(5), "scale": sizes}[path]
    width = 4 if path == "rotation" else 3
    values = [make() for _ in times]
    if mode == "CUBICSPLINE":
        tangent = lambda: [f32(rng.uniform(-1, 1)) for _ in range(width)]
        values = [[tangent(), v, tangent()] for v in values]
    return {"node": node, "path": path, "mode": mode, "times": times, "values": values}


def add_animation(name, tracks):
    samplers, channels = [], []
    for track in tracks:
        rows = [r for v in track["values"] for r in v] if track["mode"] == "CUBICSPLINE" else track["values"]
        samplers.append({"input": accessor([(t,) for t in track["times"]], "SCALAR"),
                         "output": accessor(rows, "VEC4" if track["path"] == "rotation" else "VEC3"),
                         "interpolation": track["mode"]})
        channels.append({"sampler": len(samplers) - 1, "target": {"node": track["node"], "path": track["path"]}})
    gltf["animations"].append({"name": name, "samplers": samplers, "channels": channels})


modes = ["LINEAR", "STEP", "CUBICSPLINE"]
scene = {"nodes": gltf["nodes"], "parents": {}}


def add_node(parent, **node):
    index = len(gltf["nodes"])
    gltf["nodes"].append(node)
    if parent is not None:
        gltf["nodes"][parent].setdefault("children", []).append(index)
        scene["parents"][index] = parent
    return index


# The children come before their parents in the file, except for those of the first rig.
rig = add_node(None, name="rig", translation=vector(3), rotation=quaternion(), scale=sizes())
fixed = add_node(rig, matrix=[f32(x) for column in zip(*matrix_of(vector(2), quaternion(), [1, 1, 1])) for x in column])
flying = add_node(fixed, name="Flying", camera=0, translation=vector(3), rotation=quaternion())
triangle = add_node(None, name="triangle", mesh=0)
still = add_node(triangle, name="Still", camera=2, translation=vector(3), rotation=quaternion())
flat = add_node(None, name="Flat", camera=1)
carried = add_node(rig, camera=2, translation=vector(3), scale=[-1, 1, 1])  # named by its camera
twice = add_node(None, name="Still", camera=0, translation=[0, 0, 5])
wide = add_node(None, name="Wide", camera=3)
busy = add_node(None, name="Busy", camera=0)
tiny = add_node(None, name="Tiny", camera=0, scale=[0, 0, 0])
still_end = [still, triangle]

first = [random_track(rig, p, m) for p, m in zip(["translation", "rotation", "scale"], rng.sample(modes, 3))]
first += [random_track(flying, p, m) for p, m in zip(["translation", "rotation"], rng.sample(modes, 2))]
second = [random_track(busy, "translation", "LINEAR"), random_track(busy, "rotation", "CUBICSPLINE")]
third = [random_track(busy, "rotation", "LINEAR"), random_track(busy, "translation", "STEP")]
add_animation("Flight", first)
add_animation("One", second)
add_animation("Two", third)
gltf["scenes"] = [{"nodes": [n for n in range(len(gltf["nodes"])) if n not in scene["parents"]]}]
gltf["buffers"] = [{"byteLength": len(data), "uri": "cameras.bin"}]
with open(os.path.join(folder, "cameras.bin"), "wb") as out:
    out.write(data)
with open(os.path.join(folder, "cameras.gltf"), "w") as out:
    json.dump(gltf, out)
del gltf["buffers"][0]["uri"]  # the same as one file
text = json.dumps(gltf).encode()
text += b" " * (-len(text) % 4)
data += b"\0" * (-len(data) % 4)
with open(os.path.join(folder, "cameras.glb"), "wb") as out:
    out.write(struct.pack("<III", 0x46546C67, 2, 28 + len(text) + len(data)) +
              struct.pack("<II", len(text), 0x4E4F534A) + text + struct.pack("<II", len(data), 0x004E4942) + data)


# --- the comparison

def poses(model, name, *more):
    record = os.path.join(folder, "r.json")
    subprocess.run([diptych, "dump", "--model", os.path.join(folder, model), "--path", name, "--size", "8x6",
                    "--fps", str(FPS), "--frames", "0:76", "--path-end", "once", "--json", record, *more],
                   check=True, stderr=subprocess.DEVNULL)
    return [frame["pose"] for frame in json.load(open(record))["frames"]]


checks, worst = 0, 0.0


def compare(name, node, animation, fov, *more, model="cameras.gltf", turn=lambda v: v):
    global checks, worst
    for k, pose in enumerate(poses(model, name, *more)):
        expected = view_of(world_of(scene, node, animation, min(k / FPS, DURATION)))
        for part, found in zip(expected, view_of_pose(pose)):
            error = max(abs(a - b) for a, b in zip(turn(part), found))
            worst = max(worst, error)
            checks += 1
            if not error < 1e-4:
                raise SystemExit("%s, frame %d: expected %s, found %s" % (name, k, turn(part), found))
        if abs(pose["fov_y_deg"] - math.degrees(fov)) > 1e-9:
            raise SystemExit("%s: the field of view is %r" % (name, pose["fov_y_deg"]))


compare("Flying", flying, first, 0.7)
compare("Flying", flying, first, 0.7, model="cameras.glb")
compare("Flying", flying, first, 0.7, "--up", "z", turn=lambda v: [v[0], v[2], -v[1]])
compare("Lens", carried, first, 1.2)
compare("Still", still, [], 1.2)
compare("Still 2", twice, [], 0.7)
compare("Busy/One", busy, second, 0.7)
compare("Busy/Two", busy, third, 0.7)
compare("Busy/Two", busy, third, math.radians(33), "--fov", "33")
print("seed %d: %d vectors agree, the greatest difference is %.2g" % (seed, checks, worst))
