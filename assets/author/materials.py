"""The materials: pictures, their size in metres, and how light reaches the surface.

Light comes from the baked light map where `lightmapped` is true, else from the renderer's fixed
light on vertex normals, which suits leaf cards: their normals point out of the crown.

A normal map costs a tenth of a fragment's time, so only surfaces on which the camera paths show it
have one: the setts and the piers of the fence. (The renderer does not use that of the water.)
"""
from dataclasses import dataclass


@dataclass(frozen=True)
class Material:
    tile_m: tuple = (1.0, 1.0)  # a picture's width and height on the surface
    picture: str = None
    normal_map: bool = False
    colour_lin: tuple = (1.0, 1.0, 1.0)  # base colour; multiplies the picture
    roughness: float = 0.8
    surface: str = "solid"  # the node's tag: solid, mask, glass, water, sky
    lightmapped: bool = True
    double_sided: bool = False
    density: float = 1.0  # texels of the light map per metre, relative to other materials
    opacity: float = 1.0  # below 1: the surface is blended
    clamp_v: bool = False


MATERIALS = {
    "paving": Material((2.4, 2.4), "paving.jpg", roughness=0.55),
    "setts": Material((1.0, 1.0), "setts.jpg", True, roughness=0.5),
    "ashlar": Material((2.0, 2.0), "ashlar.jpg", True, roughness=0.75),
    "ashlar_far": Material((2.0, 2.0), "ashlar.jpg", roughness=0.75),
    "carved": Material((1.0, 1.0), "carved.jpg", roughness=0.7),
    "plaster": Material((4.0, 4.0), "plaster.jpg", roughness=0.9),
    "brick": Material((2.0, 2.0), "brick.jpg", roughness=0.8, density=0.5),
    "roof": Material((1.0, 1.6), "roof.jpg", roughness=0.7),
    "wood": Material((1.0, 1.0), "wood.jpg", roughness=0.8, density=0.5),
    "door": Material((1.24, 2.45), "door.jpg", roughness=0.6, density=0.6),
    "shutter": Material((0.56, 1.66), "shutter.jpg", roughness=0.5, density=0.8),
    "terracotta": Material((0.5, 0.5), "terracotta.jpg", roughness=0.7),
    "soil": Material(colour_lin=(0.060, 0.038, 0.022), density=0.2),
    "foliage": Material(colour_lin=(0.018, 0.046, 0.009), lightmapped=False),
    "joint": Material(colour_lin=(0.030, 0.020, 0.012), lightmapped=False),
    "iron": Material(colour_lin=(0.020, 0.024, 0.026), roughness=0.4, density=0.4),
    "bronze": Material(colour_lin=(0.16, 0.10, 0.04), roughness=0.35, density=0.4),
    "lamp": Material(colour_lin=(0.80, 0.62, 0.34), roughness=0.3, density=0.4),
    "glass": Material((0.5, 1.7), "glass.jpg", roughness=0.08, surface="glass", density=0.6),
    "water": Material((1.6, 1.6), "water.jpg", True, roughness=0.05, surface="water",
                      opacity=0.3),
    "pool": Material((1.0, 1.0), "carved.jpg", roughness=0.4),
    "fence": Material((2.0, 2.0), "fence.png", roughness=0.4, surface="mask", lightmapped=False,
                      double_sided=True, clamp_v=True),
    "leaf": Material((1.0, 1.0), "leaf.png", roughness=0.6, surface="mask", lightmapped=False,
                     double_sided=True),
    "flower": Material((1.0, 1.0), "flower.png", roughness=0.6, surface="mask", lightmapped=False,
                       double_sided=True),
    "sky": Material((420.0, 420.0), "sky.jpg", surface="sky", lightmapped=False),
}
