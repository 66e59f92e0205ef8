"""Models of shapes and motion. A function returns the model, the pose of the camera, its vertical
field of view in degrees, and more arguments of Model.save."""
import math

import numpy as np

from shapes import Model, box, glyph, look, quad, sphere, turn

UNLIT = {"KHR_materials_unlit": {}}


def double_sided():
    m = Model("double_sided",
              "Open half pipes, seen from inside and outside: both shaded by the side that is "
              "seen (normal turned on back faces); the right one is single-sided, so its inside "
              "is missing.")
    n = 24
    a = np.linspace(0, np.pi, n + 1)
    ring = np.stack([.45 * np.cos(a), a * 0, .45 * np.sin(a)], 1)
    p = np.concatenate([ring + [0, y, 0] for y in (-.6, .6)])
    nn = np.concatenate([np.stack([np.cos(a), a * 0, np.sin(a)], 1)] * 2)
    k = np.arange(n)
    i = np.concatenate([np.stack([k + 1, k, k + n + 1], 1),
                        np.stack([k + 1, k + n + 1, k + n + 2], 1)])
    g = {"p": p, "n": nn, "i": i}
    m.put(turn(g, math.pi + .5), m.material((.8, .8, .8, 1), doubleSided=True), (-1.1, 0, 0))
    m.put(turn(g, .5), m.material((.8, .8, .8, 1), doubleSided=True), (0, 0, 0))
    m.put(turn(g, math.pi + .5), m.material((.8, .8, .8, 1)), (1.1, 0, 0))
    return m, look((0, 1.6, 4.2), (0, 0, 0)), 36


def no_normals():
    m = Model("no_normals",
              "Without normals a ball must be faceted (left); with normals it is smooth (right). "
              "Strip and fan below.")
    s = sphere(.6, 12, 8)
    flat = {"p": s["p"], "i": s["i"]}
    m.put(flat, m.material((.8, .7, .5, 1)), (-.8, .3, 0))
    m.put(s, m.material((.8, .7, .5, 1)), (.8, .3, 0))
    strip = {"p": np.array([[x * .2 - .6, y * .3, 0] for x in range(7) for y in (1, 0)], float)}
    strip["n"] = np.tile([0, 0, 1.0], (len(strip["p"]), 1))
    m.node(mesh=m.mesh(m.prim(strip, m.material((.9, .3, .1, 1)), mode=5)),
           translation=[-.8, -.9, 0])
    t = np.linspace(np.pi, 0, 9)
    fan = {"p": np.concatenate([[[0, 0, 0]], np.stack([np.cos(t), np.sin(t), t * 0],
                                                      1)[::-1] * .4])}
    fan["n"] = np.tile([0, 0, 1.0], (len(fan["p"]), 1))
    m.node(mesh=m.mesh(m.prim(fan, m.material((.1, .5, .9, 1)), mode=6)), translation=[.8, -.95, 0])
    return m, look((0, .1, 5), (0, -.1, 0)), 32


def sparse():
    m = Model("sparse", "Sparse accessor lifts the middle of the strip into a roof; flat is wrong.")
    g = {"p": np.array([[x, y, 0] for x in range(-3, 4) for y in (0, 1)], float)}
    k = np.arange(6) * 2
    g["i"] = np.concatenate([np.stack([k, k + 2, k + 1], 1), np.stack([k + 1, k + 2, k + 3], 1)])
    p = m.prim(g, m.material((.9, .7, .2, 1), doubleSided=True))
    a = m.j["accessors"][p["attributes"]["POSITION"]]
    a["sparse"] = {"count": 2, "indices": {"bufferView": m.view(np.array([6, 7], "u2").tobytes()),
                                           "componentType": 5123},
                   "values": {"bufferView": m.view(np.array([[0, 1.2, 0], [0, 2.2, 0]],
                                                            "f4").tobytes())}}
    a["max"] = [3, 2.2, 0]
    m.node(mesh=m.mesh(p))
    return m, look((0, 1, 6), (0, 1, 0)), 34


def anim(m, node, path, times, values, mode="LINEAR"):
    m.j.setdefault("animations", [{"name": "play", "channels": [], "samplers": []}])
    a = m.j["animations"][0]
    a["samplers"].append({"input": m.acc(np.array(times, "f4"), bounds=True),
                          "output": m.acc(np.array(values, "f4")), "interpolation": mode})
    a["channels"].append({"sampler": len(a["samplers"]) - 1,
                          "target": {"node": node, "path": path}})


def skin():
    m = Model("skin",
              "A bar of five joints: the rest pose is bent to the right, at 0.5 s it is "
              "straight, at 1 s bent to the left. A straight bar at rest means that the skin is "
              "ignored.")
    n = 40
    y = np.repeat(np.linspace(0, 2, n + 1), 4)
    c = np.tile(np.array([[-.15, -.15], [.15, -.15], [.15, .15], [-.15, .15]]), (n + 1, 1))
    p = np.stack([c[:, 0], y, c[:, 1]], 1)
    i = []
    for r in range(n):
        for k in range(4):
            a, b = r * 4 + k, r * 4 + (k + 1) % 4
            i += [[a, a + 4, b], [b, a + 4, b + 4]]
    nn = p * [1, 0, 1] / .2121
    j = np.clip(y / .4, 0, 4.999).astype(int)
    f = np.clip(y / .4 - j - .5, 0, 1) * (j < 4)
    joints, weights = np.zeros((len(p), 4), "u1"), np.zeros((len(p), 4), "f4")
    joints[:, 0], joints[:, 1] = j, np.minimum(j + 1, 4)
    weights[:, 0], weights[:, 1] = 1 - f, f
    pr = m.prim({"p": p, "n": nn, "i": np.array(i)}, m.material((.3, .7, .4, 1), rough=.6),
                {"JOINTS_0": m.acc(joints), "WEIGHTS_0": m.acc(weights)})

    def q(angle):
        return [0, 0, math.sin(angle / 2), math.cos(angle / 2)]

    first = len(m.j["nodes"])
    for k in range(5):
        m.node(root=k == 0, name="j%d" % k, translation=[0, .4 if k else 0, 0],
               rotation=q(-.35 if k else 0), **({"children": [first + k + 1]} if k < 4 else {}))
    ibm = np.tile(np.eye(4), (5, 1, 1))
    for k in range(5):
        ibm[k, 3, 1] = -.4 * k
    m.j["skins"] = [{"joints": list(range(first, first + 5)),
                     "inverseBindMatrices": m.acc(ibm.reshape(5, 16).astype("f4"))}]
    m.node(mesh=m.mesh(pr), skin=0, translation=[9, 9, 9])
    for k in range(1, 5):
        anim(m, first + k, "rotation", [0, .5, 1], [q(-.35), q(0), q(.35)])
    return m, look((0, .9, 5), (0, .9, 0)), 34, {"times": [.75]}


def morph():
    m = Model("morph",
              "Weights at rest: mesh 0 (frown), mesh 1 (smile), node's weights 1 over mesh 0 "
              "(smile). Three frowns mean that morphs are ignored.")
    x = np.linspace(-1, 1, 21)
    base = np.concatenate([np.stack([x, .5 * -x * x - o, x * 0], 1) for o in (0, .2)])
    smile = np.concatenate([np.stack([x * 0, x * x, x * 0], 1)] * 2)
    k = np.arange(20)
    i = np.concatenate([np.stack([k + 21, k + 22, k], 1), np.stack([k, k + 22, k + 1], 1)])
    g = {"p": base, "n": np.tile([0, 0, 1.0], (42, 1)), "i": i}
    mat = m.material((.9, .2, .2, 1), doubleSided=True)
    for q, (mw, nw) in enumerate((([0.0], None), ([1.0], None), ([0.0], [1.0]))):
        pr = m.prim(g, mat)
        pr["targets"] = [{"POSITION": m.acc(smile.astype("f4"), bounds=True)}]
        d = {"mesh": m.mesh(pr, weights=mw), "translation": [2.4 * (q - 1), 0, 0]}
        if nw:
            d["weights"] = nw
        m.node(**d)
    anim(m, 0, "weights", [0, 1, 2], [0, 1, 0])
    return m, look((0, 0, 8), (0, 0, 0)), 40, {"times": [.5]}


def animation():
    m = Model("animation",
              "Boxes over ticks: at t s the red box (LINEAR), the green one (STEP) and the blue "
              "one (CUBICSPLINE) stand where docs say; the rest pose is far left, so a box at -2 "
              "means that nothing plays.")
    b = box(.3, .3, .3)
    for k in range(5):
        m.put(quad(.05, 2.2), m.material((.6, .6, .6, 1), ext=UNLIT), (k - 2, 0, -.3))
    for k, (mode, c) in enumerate((("LINEAR", (1, .1, .1)), ("STEP", (.1, .8, .1)),
                                   ("CUBICSPLINE", (.2, .3, 1)))):
        y = .7 - .7 * k
        nd = m.put(b, m.material(c + (1,)), (-2, y, 0))
        v = [[x, y, 0] for x in (-1, 0, 1, 2)]
        if mode == "CUBICSPLINE":
            v = [w for x in v for w in ([0, 0, 0], x, [0, 0, 0])]
        anim(m, nd, "translation", [0, 1, 2, 3], v, mode)
    return m, look((0, 0, 6), (0, 0, 0)), 42, {"times": [1.25]}


def instancing():
    m = Model("instancing",
              "Nine small cubes in a ring (EXT_mesh_gpu_instancing). One cube in the middle is "
              "wrong.")
    a = np.arange(9) / 9 * 2 * np.pi
    t = np.stack([np.cos(a), np.sin(a), a * 0], 1).astype("f4")
    r = np.stack([a * 0, a * 0, np.sin(a / 2), np.cos(a / 2)], 1).astype("f4")
    e = {"EXT_mesh_gpu_instancing": {"attributes": {"TRANSLATION": m.acc(t), "ROTATION": m.acc(r)}}}
    m.put(box(.35, .35, .35), m.material((.2, .6, .9, 1)), extensions=e)
    return m, look((0, 0, 5), (0, 0, 0)), 36, {"required": ["EXT_mesh_gpu_instancing"]}


def torus():
    """The model that pack_gltf.mjs packs."""
    m = Model("torus",
              "A torus with TORUS written around it, gold letters on blue; the packed twins must "
              "look the same.")
    n, k = 64, 32
    u, v = np.meshgrid(np.linspace(0, 1, n + 1), np.linspace(0, 1, k + 1))
    a, b = u.ravel() * 2 * np.pi, v.ravel() * 2 * np.pi
    d = np.stack([np.cos(b) * np.cos(a), np.sin(b), -np.cos(b) * np.sin(a)], 1)
    p = np.stack([np.cos(a), a * 0, -np.sin(a)], 1) + .45 * d
    q = (np.arange(k)[:, None] * (n + 1) + np.arange(n)[None]).ravel()
    i = np.concatenate([np.stack([q, q + 1, q + n + 1], 1),
                        np.stack([q + 1, q + n + 2, q + n + 1], 1)])
    pic = np.zeros((128, 512, 3), np.uint8) + np.array((30, 50, 140), np.uint8)
    pic[84:124] = np.tile(glyph("TORUS ", 256, 40, (255, 190, 60), (30, 50, 140)), (1, 2, 1))
    t = m.texture(pic)
    m.put({"p": p, "n": d, "uv": np.stack([u.ravel(), 1 - v.ravel()], 1), "i": i},
          m.textured(t, rough=.4))
    return m, look((0, 2.2, 3.4), (0, 0, 0)), 40
