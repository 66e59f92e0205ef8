#!/usr/bin/env python3
"""Writes small glTF 2.0 models, one for each feature.

Usage: make_models.py FOLDER      needs numpy

Beside NAME.glb, NAME.pose has a line for each view: x y z qx qy qz qw fov [seconds]. A view with a
time shows the first animation at this time, one without it the model at rest. NAME.txt says what
right looks like.
"""
import pathlib
import sys

import meshes
import surfaces

MODELS = (surfaces.align, surfaces.align_lit, surfaces.metal_rough, surfaces.metal_rough_map,
          surfaces.defaults, surfaces.emissive, surfaces.occlusion, surfaces.blend,
          surfaces.transform, surfaces.wrap, surfaces.nearest, surfaces.sets,
          surfaces.vertex_colour, surfaces.vertex_alpha, surfaces.normal_map, surfaces.unlit,
          surfaces.specular_ior, surfaces.clearcoat, surfaces.sheen, surfaces.transmission,
          surfaces.glass, surfaces.rough_glass,
          meshes.double_sided, meshes.no_normals, meshes.sparse, meshes.skin, meshes.morph,
          meshes.animation, meshes.instancing, meshes.torus)


def main():
    folder = pathlib.Path(sys.argv[1])
    folder.mkdir(parents=True, exist_ok=True)
    for make in MODELS:
        model, pose, fov, *more = make()
        model.save(folder, pose, fov, **(more[0] if more else {}))


main()
