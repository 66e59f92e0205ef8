#!/usr/bin/env python3
"""Draws the courtyard from Python and writes a PNG. Needs cffi (Debian: python3-cffi).

    courtyard.py DIR PICTURE.png SETTINGS

DIR is the folder that Diptych was installed to.
"""
import sys

import cffi


def main():
    folder, picture, settings = sys.argv[1:]
    ffi = cffi.FFI()
    with open(folder + "/include/diptych/diptych.cdef", encoding="utf-8") as declarations:
        ffi.cdef(declarations.read())
    # Through a library, one also calls those that it links: scene, pipeline and base.
    assets, campaths, files = (ffi.dlopen("%s/lib/libdiptych-%s.so" % (folder, name))
                               for name in ("assets", "campaths", "files"))
    err = ffi.new("DipError *")

    def require(result):
        if not result:
            sys.exit("courtyard: " + ffi.string(err.message).decode())
        return result

    pool = require(assets.dip_pool_create(0, err))  # A thread for each processor.
    model_file = ffi.new("char[]", (folder + "/share/diptych/assets/courtyard/court.gltf").encode())
    model = require(assets.dip_model_load_with_normals(ffi.new("char *[]", [model_file]), 1, pool,
                                                       ffi.NULL, err))
    scene = require(assets.dip_scene_create(assets.dip_model_scene_def(model), pool, err))
    path = ffi.new("DipCamPath **")
    path_file = folder + "/share/diptych/campaths/aa.pth"
    require(campaths.dip_campath_load(path_file.encode(), path, err))
    pose = ffi.new("DipPose *", {"fov_y_deg": 50.0})
    campaths.dip_campath_sample(path[0], 0, pose)

    renderer_def = ffi.new("DipRendererDef *", assets.dip_renderer_default_def())
    renderer_def.pool = pool
    quality = ffi.addressof(renderer_def, "quality")
    require(assets.dip_quality_parse(settings.encode(), quality, err))
    renderer = require(assets.dip_renderer_create(renderer_def, err))
    frame = ffi.new("DipFrame *")
    require(assets.dip_renderer_draw(renderer, scene, pose, 0, frame, err))
    require(files.dip_png_write(picture.encode(), frame, err))
    print("%d samples shown" % frame.counters.samples_shown)


if __name__ == "__main__":
    main()
