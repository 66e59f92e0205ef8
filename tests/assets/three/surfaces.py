"""Models of materials and textures. A function returns the model, the pose of the camera and its
vertical field of view in degrees."""
import math

import numpy as np

from shapes import Model, box, checker, glyph, look, quad, sphere, turn

UNLIT = {"KHR_materials_unlit": {}}
REPEAT, CLAMP, MIRROR = 10497, 33071, 33648
CORNER_COLOURS = np.array([[1, 0, 0, 1], [0, 1, 0, 1], [0, 0, 1, 1], [1, 1, 1, 1]], "f4")


def align():
    m = Model("align",
              "Unlit checkerboards, ramps and a slanted floor: camera, colours, mips and "
              "anisotropy must coincide.")
    t = m.texture(checker(8, 256))
    m.put(turn({**quad(14, 40, 1), "uv": quad(14, 40, 1)["uv"] * [14, 40]}, -math.pi / 2, 0),
          m.textured(t, ext=UNLIT), (0, -1, -16))
    ramp = np.tile(np.arange(256, dtype=np.uint8)[None, :, None], (32, 1, 3))
    m.put(quad(4, .5), m.textured(m.texture(ramp, (CLAMP, CLAMP)), ext=UNLIT), (0, 1.2, 0))
    for k in range(9):
        m.put(quad(.4, .4), m.material([k / 8] * 3 + [1], ext=UNLIT), (-1.8 + k * .45, .65, 0))
    for k, c in enumerate([(1, 0, 0), (0, 1, 0), (0, 0, 1), (1, .5, 0), (.2, .04, .6)]):
        m.put(turn(box(.5, .5, .5), .5 + k), m.material(c + (1,), ext=UNLIT),
              (-1.6 + .8 * k, -.2, 0))
    return m, look((.6, .9, 4.2), (0, .1, 0)), 45


def align_lit():
    m = Model("align_lit",
              "Matt bodies without any reflection (specular 0): the diffuse light must coincide "
              "to a code or two.")
    s = sphere()
    e = {"KHR_materials_specular": {"specularFactor": 0.0}}
    for k, c in enumerate([(1, 1, 1), (.8, .1, .1), (.1, .3, .8)]):
        m.put(s, m.material(c + (1,), ext=e), (k - 1, .5, 0))
        m.put(turn(turn(box(.6, .6, .6), .5 + k), .4, 0), m.material(c + (1,), ext=e),
              (k - 1, -.5, 0))
    return m, look((.3, .4, 5), (0, 0, 0)), 30


def metal_rough():
    m = Model("metal_rough",
              "Rows: metallic 1 (top), 0.5, 0; columns: roughness 0 to 1. Top left is a mirror, "
              "bottom right is chalk.")
    s = sphere()
    for r in range(3):
        for c in range(6):
            m.put(s, m.material((1, .71, .29, 1), 1 - r / 2, c / 5), (c - 2.5, 1 - r, 0))
    return m, look((0, 0, 8), (0, 0, 0)), 36


def metal_rough_map():
    m = Model("metal_rough_map",
              "Left: metal says OK (blue channel is metallic). Right: gloss says OK (green is "
              "roughness). NO must not show.")
    a = np.zeros((64, 128, 3), np.uint8)
    a[..., 2] = glyph("OK", 128, 64, (255,) * 3, (0,) * 3)[..., 0]
    a[..., 0] = glyph("NO", 128, 64, (255,) * 3, (0,) * 3)[..., 0]
    a[..., 1] = 90
    b = np.zeros((64, 128, 3), np.uint8)
    b[..., 1] = glyph("OK", 128, 64, (25,) * 3, (255,) * 3)[..., 0]
    b[..., 0] = glyph("NO", 128, 64, (25,) * 3, (255,) * 3)[..., 0]
    b[..., 2] = 255
    for k, tex in enumerate((a, b)):
        t = m.texture(tex)
        pbr = {"metallicRoughnessTexture": {"index": t}}
        m.put(quad(2, 1), m.material((.95, .64, .3, 1), 1.0, 1.0, pbr=pbr), (2.1 * k - 1.05, 0, 0))
    return m, look((-.6, -.5, 4), (0, 0, 0)), 46


def defaults():
    m = Model("defaults",
              "Left to right: no material (white metal 1 rough 1), material {} (the same), "
              "metallic 0 by factor (matt white).")
    s = sphere()
    m.node(mesh=m.mesh(m.prim(s)), translation=[-1, 0, 0])
    m.j["materials"].append({"name": "empty"})
    m.put(s, 0, (0, 0, 0))
    m.put(s, m.material((1, 1, 1, 1), 0.0, 1.0), (1, 0, 0))
    return m, look((0, 0, 5), (0, 0, 0)), 35


def emissive():
    m = Model("emissive",
              "Black boxes glow: red by factor, GLOW by map, brighter by strength 4 (clamped to "
              "white). All black is wrong.")
    t = m.texture(glyph("GLOW", 128, 64, (255, 180, 40), (0, 0, 0)))
    b = box(1.2, .8, .4)
    strong = {"KHR_materials_emissive_strength": {"emissiveStrength": 4.0}}
    m.put(b, m.material((0, 0, 0, 1), emissiveFactor=[.8, .05, .05]), (-1.5, 0, 0))
    m.put(b, m.material((0, 0, 0, 1), emissiveFactor=[1, 1, 1], emissiveTexture={"index": t}),
          (0, 0, 0))
    m.put(b, m.material((0, 0, 0, 1), emissiveFactor=[.25, .2, .05], ext=strong), (1.5, 0, 0))
    return m, look((.5, .7, 4.5), (0, 0, 0)), 46


def occlusion():
    m = Model("occlusion",
              "AO in the red channel dims ambient light only, strength 1 (left), 0.5 (middle), "
              "through TEXCOORD_1 (right). Green and blue hold NO and must not show.")
    a = np.full((64, 128, 3), 255, np.uint8)
    a[..., 0] = glyph("AO", 128, 64, (20,) * 3, (255,) * 3)[..., 0]
    a[..., 1] = a[..., 2] = glyph("NO", 128, 64, (20,) * 3, (255,) * 3)[..., 0]
    t = m.texture(a)
    g = quad(1.3, .9)
    g["uv1"] = g["uv"].copy()
    m.put(g, m.material((.8, .8, .8, 1), occlusionTexture={"index": t}), (-1.4, 0, 0))
    m.put(g, m.material((.8, .8, .8, 1), occlusionTexture={"index": t, "strength": .5}), (0, 0, 0))
    g2 = {**g, "uv": g["uv"] * 0}
    m.put(g2, m.material((.8, .8, .8, 1), occlusionTexture={"index": t, "texCoord": 1}),
          (1.4, 0, 0))
    return m, look((0, .2, 4.2), (0, 0, 0)), 42


def blend():
    m = Model("blend",
              "Panes in file order far to near and near to far must look alike; alpha 0.25, 0.5, "
              "0.75; a soft disc; the cube shows its back faces through the front.")
    m.put(quad(6, 3), m.textured(m.texture(checker(12, 192, (250, 250, 250), (30, 30, 30))),
                                 ext=UNLIT), (0, 0, -1.2))
    cols = [(1, 0, 0), (0, .8, 0), (0, 0, 1)]
    for side, order in ((-1.9, (0, 1, 2)), (-.4, (2, 1, 0))):
        for k in order:
            m.put(quad(.8, .8), m.material(cols[k] + (.5,), alphaMode="BLEND", ext=UNLIT),
                  (side + .22 * k - .2, .22 * k - .2, -.6 + .3 * k))
    for k in range(3):
        m.put(quad(.4, .4), m.material((1, .6, 0, .25 * (k + 1)), alphaMode="BLEND", ext=UNLIT),
              (.75, .55 - .5 * k, 0))
    y, x = np.indices((64, 64)) - 31.5
    d = np.zeros((64, 64, 4), np.uint8)
    d[..., 0] = 255
    d[..., 3] = (255 * np.clip(1.2 - np.hypot(x, y) / 26, 0, 1)).astype(np.uint8)
    m.put(quad(.9, .9), m.textured(m.texture(d), alphaMode="BLEND", ext=UNLIT), (1.5, .45, 0))
    m.put(turn(turn(box(.6, .6, .6), .6), .4, 0),
          m.material((.2, .7, 1, .45), alphaMode="BLEND", doubleSided=True, rough=.3),
          (1.55, -.55, .2))
    return m, look((0, 0, 5), (0, 0, 0)), 44


def transform():
    m = Model("texture_transform",
              "Every tile shows one upright F that fills it. Anything else is wrong.")
    f = glyph("F", 128, 128, (20, 20, 90), (250, 220, 120))
    f[:4] = f[-4:] = f[:, :4] = f[:, -4:] = (200, 0, 0)
    t = m.texture(f)

    def inverse(offset, rotation, scale, g):
        c, s = math.cos(rotation), math.sin(rotation)
        a = np.array([[c * scale[0], s * scale[1]], [-s * scale[0], c * scale[1]]])
        g["uv"] = (g["uv"] - offset) @ np.linalg.inv(a).T
        return g

    cases = [((0, 0), 0, (1, 1)), ((.5, .25), 0, (1, 1)), ((0, 0), 0, (.5, .25)),
             ((0, 0), math.pi / 2, (1, 1)), ((.3, -.2), .7, (2, .5)), ((0, 1), 0, (1, -1))]
    for k, (o, r, s) in enumerate(cases):
        e = {"KHR_texture_transform": {"offset": list(o), "rotation": r, "scale": list(s)}}
        m.used.add("KHR_texture_transform")
        material = m.textured(t, ext=UNLIT)
        m.j["materials"][material]["pbrMetallicRoughness"]["baseColorTexture"]["extensions"] = e
        m.put(inverse(o, r, s, quad(.9, .9)), material, (k % 3 - 1, .5 - k // 3, 0))
    return m, look((0, 0, 4), (0, 0, 0)), 34


def framed_f():
    f = glyph("F", 32, 32, (20, 20, 90), (250, 220, 120))
    f[:2] = f[-2:] = f[:, :2] = f[:, -2:] = (200, 0, 0)
    return f


def three_times(g):
    """The coordinates run from -1 to 2."""
    return {**g, "uv": g["uv"] * 3 - 1}


def wrap():
    m = Model("wrap", "Left to right: repeat, clamp, mirror (F faces alternate), mirror v only.")
    modes = ((REPEAT, REPEAT), (CLAMP, CLAMP), (MIRROR, MIRROR), (REPEAT, MIRROR))
    for k, mode in enumerate(modes):
        t = m.texture(framed_f(), mode)
        m.put(three_times(quad(.95, .95)), m.textured(t, ext=UNLIT), (k - 1.5, 0, 0))
    return m, look((0, 0, 4), (0, 0, 0)), 42


def nearest():
    m = Model("nearest", "Hard texels.")
    t = m.texture(framed_f(), (REPEAT, MIRROR), nearest=True)
    m.put(three_times(quad(2, 2)), m.textured(t, ext=UNLIT))
    return m, look((0, 0, 4), (0, 0, 0)), 42


def sets():
    m = Model("texcoord_sets",
              "Colour (OK) reads set 1, emission (GLOW, lower half) reads set 0. A smear is "
              "wrong.")
    c = m.texture(glyph("OK", 128, 64, (0, 90, 0), (230, 230, 230)), (CLAMP, CLAMP))
    e = m.texture(glyph("GLOW", 128, 64, (255, 120, 0), (0, 0, 0)), (CLAMP, CLAMP))
    g = quad(2, 1)
    g["uv1"] = g["uv"] * [1, 2]
    g["uv"] = g["uv"] * [1, 2] - [0, 1]
    m.put(g, m.material(rough=1.0, emissiveFactor=[1, 1, 1],
                        emissiveTexture={"index": e, "texCoord": 0},
                        pbr={"baseColorTexture": {"index": c, "texCoord": 1}}))
    return m, look((0, 0, 3.2), (0, 0, 0)), 34


def vertex_colour():
    m = Model("vertex_colour",
              "Four like quads: colours as float, 8 bit, 16 bit, 8 bit under a texture. Linear, "
              "not sRGB.")
    c = CORNER_COLOURS
    checks = m.textured(m.texture(checker(4, 64, (255, 255, 255), (128, 128, 128))), ext=UNLIT)
    plain = m.material(ext=UNLIT)
    bytes8 = m.acc((c * 255).astype("u1"), normalized=True)
    bytes16 = m.acc((c * 65535).astype("u2"), normalized=True)
    cases = ((plain, m.acc(c[:, :3])), (plain, bytes8), (plain, bytes16), (checks, bytes8))
    for k, (material, colours) in enumerate(cases):
        prim = m.prim(quad(.9, .9), material, {"COLOR_0": colours})
        m.node(mesh=m.mesh(prim), translation=[k - 1.5, 0, 0])
    return m, look((0, 0, 5), (0, 0, 0)), 42


def vertex_alpha():
    m = Model("vertex_alpha", "The alpha of the vertices cuts the quad at its diagonal (MASK).")
    c = CORNER_COLOURS.copy()
    c[:, 3] = 0, .5, 1, .5
    material = m.material(ext=UNLIT, alphaMode="MASK", alphaCutoff=.5)
    m.node(mesh=m.mesh(m.prim(quad(1, 1), material, {"COLOR_0": m.acc(c)})))
    return m, look((0, 0, 5), (0, 0, 0)), 42


def normal_map():
    m = Model("normal_map",
              "All domes bulge and are lit from the same side as the real one (far right): "
              "plain, mirrored u, with tangents and w=-1, scale 2 (steeper), scale 0 (flat).")
    y, x = np.indices((128, 128)) - 63.5
    r = np.hypot(x, y) / 54
    z = np.sqrt(np.maximum(0, 1 - r * r * .8))
    n = np.where(r[..., None] < 1, np.stack([x / 54 * .894, -y / 54 * .894, z], -1), [0, 0, 1.0])
    pic = np.clip(n * 127 + 128, 0, 255).round().astype(np.uint8)
    t = m.texture(pic)

    def mat(**k):
        return m.material((.8, .5, .3, 1), rough=.5, normalTexture={"index": t, **k})

    m.put(quad(.9, .9), mat(), (-2.5, 0, 0))
    m.put(quad(.9, .9, flip=True), mat(), (-1.5, 0, 0))
    g = quad(.9, .9, flip=True)
    g["t"] = np.tile([-1, 0, 0, -1.0], (4, 1))
    m.put(g, mat(), (-.5, 0, 0))
    m.put(quad(.9, .9), mat(scale=2.0), (.5, 0, 0))
    m.put(quad(.9, .9), mat(scale=0.0), (1.5, 0, 0))
    s = sphere(.425)
    n = s["n"] / [1, 1, .6]
    dome = {**s, "p": s["p"] * [1, 1, .6], "n": n / np.linalg.norm(n, axis=1, keepdims=True)}
    m.put(dome, m.material((.8, .5, .3, 1), rough=.5), (2.5, 0, -.15))
    return m, look((0, 0, 5.5), (0, 0, 0)), 46


def unlit():
    m = Model("unlit",
              "Top: unlit discs keep one flat colour. Bottom: the same colours lit, with "
              "shading.")
    s = sphere()
    for k, c in enumerate([(1, 1, 1), (.8, .1, .1), (.1, .3, .8)]):
        m.put(s, m.material(c + (1,), ext=UNLIT), (k - 1, .5, 0))
        m.put(s, m.material(c + (1,)), (k - 1, -.5, 0))
    return m, look((0, 0, 5), (0, 0, 0)), 30


def specular_ior():
    m = Model("specular_ior",
              "Left to right: plain, specular 0 (no reflection), specularColor red, ior 1 "
              "(none), ior 2.4 (strong). Dark blue base.")
    s = sphere()
    e = [None, {"KHR_materials_specular": {"specularFactor": 0.0}},
         {"KHR_materials_specular": {"specularColorFactor": [4.0, .4, .4]}},
         {"KHR_materials_ior": {"ior": 1.0}}, {"KHR_materials_ior": {"ior": 2.4}}]
    for k, x in enumerate(e):
        m.put(s, m.material((.02, .03, .12, 1), rough=.15, ext=x), (k - 2, 0, 0))
    return m, look((0, 0, 6), (0, 0, 0)), 38


def clearcoat():
    m = Model("clearcoat", "Rough red metal: bare (left), a clear coat (middle; sharp reflection), "
              "a clear coat of roughness 0.5 (right).")
    s = sphere()
    coats = ({}, {"clearcoatFactor": 1.0}, {"clearcoatFactor": 1.0, "clearcoatRoughnessFactor": .5})
    for k, coat in enumerate(coats):
        ext = {"KHR_materials_clearcoat": coat} if coat else None
        m.put(s, m.material((.6, .05, .05, 1), 1.0, .7, ext=ext), (k - 1, 0, 0))
    return m, look((0, 0, 5.5), (0, 0, 0)), 34


def sheen():
    m = Model("sheen", "Black cloth with a pale rim.")
    ext = {"KHR_materials_sheen": {"sheenColorFactor": [.8, .8, 1], "sheenRoughnessFactor": .4}}
    m.put(sphere(), m.material((.02, .02, .02, 1), 0.0, 1.0, ext=ext))
    return m, look((0, 0, 5.5), (0, 0, 0)), 34


def transmission():
    m = Model("transmission",
              "The board is seen through: clear pane, tinted pane, frosted pane. A solid white "
              "pane is wrong.")
    m.put(quad(6, 3), m.textured(m.texture(checker(12, 192, (250, 250, 250), (160, 30, 30)))),
          (0, 0, -1))
    glass = {"KHR_materials_transmission": {"transmissionFactor": 1.0}}
    for k, (c, r) in enumerate((((1, 1, 1), 0), ((.2, .9, .4), 0), ((1, 1, 1), .5))):
        m.put(quad(1, 1), m.material(c + (1,), 0.0, float(r), ext=glass), (1.2 * (k - 1), 0, 0))
    return m, look((0, 0, 4.5), (0, 0, 0)), 38


def rough_glass():
    m = Model("rough_glass",
              "The board is seen through panes of roughness 0.2, 0.35 (tinted) and 0.5; 0.7, 0.5 with "
              "an ior of 1.25, and 0.4 of metal 0.5. The rougher, the more blurred; an ior below 1.5 "
              "blurs less.")
    m.put(quad(6, 3), m.textured(m.texture(checker(12, 192, (250, 250, 250), (160, 30, 30)))),
          (0, 0, -1))
    full = {"KHR_materials_transmission": {"transmissionFactor": 1.0}}
    thin = {**full, "KHR_materials_ior": {"ior": 1.25}}
    panes = [m.material((1, 1, 1, 1), 0.0, 0.2, ext=full),
             m.material((.2, .9, .4, 1), 0.0, 0.35, ext=full),
             m.material((1, 1, 1, 1), 0.0, 0.5, ext=full, alphaMode="BLEND"),
             m.material((.9, .9, .9, 1), 0.0, 0.7, ext=full),
             m.material((.7, .8, 1, 1), 0.0, 0.5, ext=thin),
             m.material((.9, .7, .4, 1), 0.5, 0.4, ext=full)]
    for k, pane in enumerate(panes):
        m.put(quad(.9, .9), pane, (1.05 * (k % 3 - 1), .5 - k // 3, 0))
    return m, look((0.3, 0.2, 4.5), (0, 0, 0)), 38


def glass():
    m = Model("glass",
              "The board is seen through smooth panes: clear, tinted, half as transmissive with a "
              "white base, of metal 0.5, coated, and of alpha 0.5. All mirror the surroundings.")
    m.put(quad(6, 3), m.textured(m.texture(checker(12, 192, (250, 250, 250), (160, 30, 30)))),
          (0, 0, -1))
    full = {"KHR_materials_transmission": {"transmissionFactor": 1.0}}
    half = {"KHR_materials_transmission": {"transmissionFactor": 0.5}}
    coated = {**full, "KHR_materials_clearcoat": {"clearcoatFactor": 1.0},
              "KHR_materials_ior": {"ior": 1.8}}
    panes = [m.material((1, 1, 1, 1), 0.0, 0.0, ext=full),
             m.material((.2, .9, .4, 1), 0.0, 0.0, ext=full),
             m.material((.9, .9, .9, 1), 0.0, 0.0, ext=half),
             m.material((.9, .7, .4, 1), 0.5, 0.0, ext=full),
             m.material((.7, .8, 1, 1), 0.0, 0.0, ext=coated),
             m.material((.8, .8, .3, .5), 0.0, 0.0, ext=full, alphaMode="BLEND")]
    for k, pane in enumerate(panes):
        m.put(quad(.9, .9), pane, (1.05 * (k % 3 - 1), .5 - k // 3, 0))
    return m, look((0.3, 0.2, 4.5), (0, 0, 0)), 38
