"""The materials of the torture scene.

A material of the kind `metal` has glTF's metallic-roughness description and no tag, so that it
reflects its surroundings. The other kinds are the tags of models (docs/models.md).
"""
from dataclasses import dataclass

COURT = "../courtyard/"


@dataclass(frozen=True)
class Material:
    kind: str = "solid"  # solid, ground (with the light map), mask, metal, water, sky
    colour_lin: tuple = (1.0, 1.0, 1.0)
    picture: str = None
    tile_m: tuple = (1.0, 1.0)  # what a whole picture measures on the surface
    normal_map: str = None
    metallic: float = 0.0
    roughness: float = 0.8
    double_sided: bool = False


MATERIALS = {
    "paving": Material("ground", picture=COURT + "paving.jpg", tile_m=(2.4, 2.4)),
    "setts": Material("ground", picture=COURT + "setts.jpg"),
    "grass": Material("ground", picture="grass.jpg", tile_m=(3.0, 3.0)),
    "meadow": Material(picture="grass.jpg", tile_m=(3.0, 3.0)),
    "ashlar": Material(picture=COURT + "ashlar.jpg", tile_m=(2.0, 2.0)),
    "brick": Material(picture=COURT + "brick.jpg", tile_m=(2.0, 2.0)),
    "roof": Material(picture=COURT + "roof.jpg", tile_m=(1.0, 1.6)),
    "plaster": Material(picture=COURT + "plaster.jpg", tile_m=(4.0, 4.0)),
    "bark": Material(picture=COURT + "wood.jpg", colour_lin=(0.95, 0.9, 0.85)),
    "leaf": Material("mask", picture=COURT + "leaf.png", double_sided=True),
    "core": Material(colour_lin=(0.018, 0.046, 0.009)),
    "hills": Material(),
    "paint": Material("mask", picture="paint.png"),
    "net": Material("mask", picture="net.png", double_sided=True),
    "text": Material(picture="text.png"),
    "dark": Material(colour_lin=(0.016, 0.019, 0.023)),
    "mast": Material(colour_lin=(0.105, 0.125, 0.125)),
    "window": Material(colour_lin=(0.05, 0.07, 0.09)),
    "white": Material(colour_lin=(0.72, 0.72, 0.68)),
    "red": Material(colour_lin=(0.30, 0.035, 0.02)),
    "cladding": Material("metal", (0.30, 0.52, 0.66), metallic=1.0, roughness=0.26),
    "steel": Material("metal", (0.66, 0.68, 0.70), metallic=1.0, roughness=0.24),
    "chrome": Material("metal", (0.80, 0.80, 0.78), metallic=1.0, roughness=0.12),
    "copper": Material("metal", (0.76, 0.40, 0.24), metallic=1.0, roughness=0.22),
    "rail": Material("metal", (0.42, 0.40, 0.38), metallic=1.0, roughness=0.3),
    "plate": Material("metal", (0.62, 0.63, 0.64), tile_m=(0.5, 0.5), normal_map="plate_n.png",
                      metallic=1.0, roughness=0.22),
    "water": Material("water", picture=COURT + "water.jpg", tile_m=(3.2, 3.2)),
    "sky": Material("sky", picture=COURT + "sky.jpg", tile_m=(420.0, 420.0)),
}
