#!/usr/bin/env python3
"""Makes the art of the gallery: gallery.py FOLDER

crab.md2, crab.pcx   a model with three sequences of key frames, and its skin (crab.py)
penguin.md2, .pcx    the model of the gallery's scene `model`, and its skin (penguin.py)
pump.glb             a machine with node animation, morph targets and a skin (pump.py)
tiles.dds            a texture in BC1 with its mip levels (block_texture.py)

Needs (Debian): python3-numpy python3-pil
"""
import pathlib
import re
import sys

import block_texture
import crab
import penguin
import pump


def normal_table():
    """The numbers of MD2's normals stand in one place only."""
    source = pathlib.Path(__file__).resolve().parent.parent / "md2_normals.c"
    rows = re.findall(r"\{(-?\d+(?:, -?\d+){5})\}", source.read_text())
    return [[int(number) for number in row.split(", ")] for row in rows]


def main():
    folder = pathlib.Path(sys.argv[1])
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "crab.md2").write_bytes(crab.md2(crab.normals_of_md2(normal_table()), "crab.pcx"))
    crab.skin().save(folder / "crab.pcx", "PCX")
    penguin.write_pcx(folder / "penguin.pcx")
    penguin.write_md2(folder / "penguin.md2")
    (folder / "pump.glb").write_bytes(pump.glb())
    (folder / "tiles.dds").write_bytes(block_texture.dds(block_texture.tiles()))


if __name__ == "__main__":
    main()
