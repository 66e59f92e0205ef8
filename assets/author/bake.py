"""Bakes the courtyard's light with Cycles on the CPU. Runs inside Blender:

    blender -b --factory-startup -P bake.py -- PICTURES OUT.npz SIDE SUN_SAMPLES ALL_SAMPLES

Writes float arrays of SIDE x SIDE texels, upper row first: `sun` (sunlight alone), `all` (sun, sky
and reflected light), `position`, `normal`, and the mask `covered`. Light is irradiance / pi, to
be multiplied by the albedo.
"""
import math
import pathlib
import sys
import time

import bpy
import numpy as np
from mathutils import Vector
from PIL import Image

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).parent))
import charts
import courtyard
import sun
from materials import MATERIALS

UNCOVERED = -1e4


def mean_albedo(pictures, material):
    """Mean linear colour of a material, without the texels that its clip map removes."""
    albedo = np.asarray(material.colour_lin)
    if material.picture:
        rgba = np.asarray(Image.open(pictures / material.picture).convert("RGBA"), float) / 255.0
        rgba = rgba[rgba[..., 3] >= 0.5]
        srgb = rgba[:, :3]
        linear = np.where(srgb <= 0.04045, srgb / 12.92, ((srgb + 0.055) / 1.055)**2.4)
        albedo = albedo * linear.mean(0)
    return albedo


def make_material(name, pictures, target):
    """A matte material; its clip map lets light through. target: picture to bake into."""
    source = MATERIALS[name]
    material = bpy.data.materials.new(name)
    material.use_nodes = True
    nodes, links = material.node_tree.nodes, material.node_tree.links
    nodes.clear()
    out = nodes.new("ShaderNodeOutputMaterial")
    diffuse = nodes.new("ShaderNodeBsdfDiffuse")
    diffuse.inputs["Color"].default_value = (*mean_albedo(pictures, source), 1.0)
    shader = diffuse.outputs[0]
    if source.surface == "mask":
        picture = nodes.new("ShaderNodeTexImage")
        picture.image = bpy.data.images.load(str(pictures / source.picture), check_existing=True)
        clear, mix = nodes.new("ShaderNodeBsdfTransparent"), nodes.new("ShaderNodeMixShader")
        links.new(picture.outputs["Alpha"], mix.inputs[0])
        links.new(clear.outputs[0], mix.inputs[1])
        links.new(shader, mix.inputs[2])
        shader = mix.outputs[0]
    elif source.lightmapped:
        picture = nodes.new("ShaderNodeTexImage")
        picture.image = target
        nodes.active = picture
    links.new(shader, out.inputs["Surface"])
    return material


class Assembly:
    """One Blender mesh gathered from surfaces placed in the world."""

    def __init__(self):
        self.positions, self.normals, self.uvs, self.triangles, self.slots = [], [], [], [], []
        self.materials = []
        self.count = 0

    def add(self, material, surface, matrix, uvs):
        if material not in self.materials:
            self.materials.append(material)
        turn = np.linalg.inv(matrix[:3, :3]).T
        normals = np.asarray(surface.normals) @ turn.T
        triangles = np.asarray(surface.triangles)
        if np.linalg.det(matrix[:3, :3]) < 0:
            triangles = triangles[:, ::-1]
        self.positions.append(np.asarray(surface.positions) @ matrix[:3, :3].T + matrix[:3, 3])
        self.normals.append(normals / np.linalg.norm(normals, axis=1, keepdims=True))
        self.uvs.append(uvs)
        self.triangles.append(triangles + self.count)
        self.slots += [self.materials.index(material)] * len(triangles)
        self.count += len(surface.positions)

    def to_object(self, name, made):
        triangles = np.concatenate(self.triangles)
        mesh = bpy.data.meshes.new(name)
        mesh.from_pydata(np.concatenate(self.positions).tolist(), [], triangles.tolist())
        corners = triangles.ravel()
        uvs = np.concatenate(self.uvs)[corners]
        mesh.uv_layers.new(name="uv").data.foreach_set("uv", uvs.astype(np.float32).ravel())
        mesh.polygons.foreach_set("material_index", self.slots)
        mesh.polygons.foreach_set("use_smooth", [True] * len(triangles))
        mesh.use_auto_smooth = True
        mesh.normals_split_custom_set(np.concatenate(self.normals)[corners].tolist())
        for material in self.materials:
            mesh.materials.append(made[material])
        thing = bpy.data.objects.new(name, mesh)
        thing.cycles.shadow_terminator_geometry_offset = 0.6
        bpy.context.scene.collection.objects.link(thing)
        return thing


def picture_uvs(material, surface):
    return np.asarray(surface.uvs) / np.asarray(MATERIALS[material].tile_m)


def assemble(meshes, made):
    """The baked meshes, each at one position, and all other objects, which only throw shadows.
    Meshes that have the light of another one are neither."""
    baked, others = Assembly(), Assembly()
    for mesh in (m for m in meshes if not m.part.light_of):
        for material, surface in mesh.part.surfaces.items():
            if MATERIALS[material].surface == "sky":
                continue
            rest = list(mesh.matrices)
            if MATERIALS[material].lightmapped:
                uvs = mesh.light_uvs[material] * (1, -1) + (0, 1)
                baked.add(material, surface, mesh.baked_at, uvs)
                del rest[len(rest) // 2]
            for matrix in rest:
                others.add(material, surface, matrix, picture_uvs(material, surface))
    others.to_object("others", made)
    return baked.to_object("baked", made)


def make_light():
    light = bpy.data.lights.new("sun", "SUN")
    light.color, light.energy = sun.SUN_COLOUR, sun.SUN_STRENGTH
    light.angle = math.radians(sun.SUN_ANGLE_DEG)
    thing = bpy.data.objects.new("sun", light)
    thing.rotation_euler = Vector(sun.DIRECTION).to_track_quat("Z", "Y").to_euler()
    bpy.context.scene.collection.objects.link(thing)
    world = bpy.data.worlds.new("sky")
    bpy.context.scene.world = world
    world.use_nodes = True
    nodes, links = world.node_tree.nodes, world.node_tree.links
    where, split = nodes.new("ShaderNodeTexCoord"), nodes.new("ShaderNodeSeparateXYZ")
    ramp = nodes.new("ShaderNodeValToRGB")
    ramp.color_ramp.elements[0].color = (*sun.SKY_HORIZON, 1)
    ramp.color_ramp.elements[1].color = (*sun.SKY_ZENITH, 1)
    ramp.color_ramp.elements[1].position = 0.7
    links.new(where.outputs["Generated"], split.inputs[0])
    links.new(split.outputs["Z"], ramp.inputs[0])
    links.new(ramp.outputs[0], nodes["Background"].inputs["Color"])
    nodes["Background"].inputs["Strength"].default_value = sun.SKY_STRENGTH
    return thing, nodes["Background"].inputs["Strength"]


def set_up_cycles():
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    cycles = scene.cycles
    cycles.device, cycles.seed = "CPU", 1
    cycles.use_denoising = cycles.use_adaptive_sampling = False
    cycles.max_bounces, cycles.diffuse_bounces, cycles.transparent_max_bounces = 5, 4, 16
    cycles.caustics_reflective = cycles.caustics_refractive = False
    cycles.sample_clamp_indirect = 6.0
    scene.render.bake.use_clear = False
    scene.render.bake.margin = 0


def bake(target, side, kind, samples, passes=None):
    """Bakes one kind of light to floats, upper row first; UNCOVERED without a surface."""
    bpy.context.scene.cycles.samples = samples
    target.pixels.foreach_set(np.full(side * side * 4, UNCOVERED, np.float32))
    target.update()
    start = time.time()
    options = {"pass_filter": passes} if passes else {}
    if kind == "NORMAL":
        options["normal_space"] = "OBJECT"
    bpy.ops.object.bake(type=kind, use_clear=False, margin=0, **options)
    texels = np.empty(side * side * 4, np.float32)
    target.pixels.foreach_get(texels)
    print(f"baked {kind} {passes or ''} in {time.time() - start:.0f} s", flush=True)
    return texels.reshape(side, side, 4)[::-1, :, :3].copy()


def main(pictures, out, side, sun_samples, all_samples):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    set_up_cycles()
    target = bpy.data.images.new("light", side, side, alpha=True, float_buffer=True)
    target.colorspace_settings.name = "Non-Color"
    meshes = charts.lay_out(courtyard.courtyard(), side)
    made = {name: make_material(name, pictures, target) for name in MATERIALS}
    thing = assemble(meshes, made)
    _, sky_strength = make_light()
    bpy.context.view_layer.objects.active = thing
    thing.select_set(True)
    position = bake(target, side, "POSITION", 1)
    normal = bake(target, side, "NORMAL", 1) * 2 - 1
    whole = bake(target, side, "DIFFUSE", all_samples, {"DIRECT", "INDIRECT"})
    sky_strength.default_value = 0.0
    sunlight = bake(target, side, "DIFFUSE", sun_samples, {"DIRECT"})
    covered = sunlight[..., 0] > UNCOVERED / 2
    np.savez(out, sun=sunlight, all=whole, position=position, normal=normal, covered=covered)


if __name__ == "__main__":
    arguments = sys.argv[sys.argv.index("--") + 1:]
    main(pathlib.Path(arguments[0]), arguments[1], *map(int, arguments[2:]))
