#!/usr/bin/env python3
"""Makes the tiling colour pictures (*.jpg) and normal maps (*_n.jpg) of the courtyard.

Both come from one height field and one tone per stone, brick, tile or plank.
Usage: textures.py FOLDER [NAME...]
"""
import pathlib
import sys

import numpy as np

from noise import halved, mix, noise, normal_map, palette, rgb, save_jpeg, step

PAVING_BAND_M = 0.2


def metres(shape, size_m, wobble_m=0.0, seed=0):
    """Coordinates of the texels' centres, x to the right and y down, bent by smooth noise."""
    rows, columns = shape
    y, x = np.mgrid[0:rows, 0:columns].astype(np.float32)
    x, y = (x + 0.5) / columns * size_m[0], (y + 0.5) / rows * size_m[1]
    if wobble_m:
        x = x + wobble_m * noise(shape, 2, 40, 1.2, seed)
        y = y + wobble_m * noise(shape, 2, 40, 1.2, seed + 1)
    return x, y


def courses(shape, size_m, row_widths_m, corner_m, wobble_m, seed, height=None):
    """Courses of stones. row_widths_m: per course (offset, [widths that sum to the tile's]).
    height: of a course, metres; where it is not given the courses fill the tile.

    Returns each texel's distance to its stone's edge in metres (negative in the joint's corners)
    and its stone's number.
    """
    x, y = metres(shape, size_m, wobble_m, seed)
    height = height or size_m[1] / len(row_widths_m)
    row = np.floor(y / height).astype(int) % len(row_widths_m)
    across = y - np.floor(y / height) * height
    distance = np.zeros(shape, np.float32)
    number = np.zeros(shape, int)
    first = 0
    for r, (offset, widths) in enumerate(row_widths_m):
        edges = np.concatenate([[0.0], np.cumsum(widths)])
        here = row == r
        along = (x[here] - offset) % size_m[0]
        i = np.clip(np.searchsorted(edges, along, side="right") - 1, 0, len(widths) - 1)
        half_x, half_y = np.asarray(widths)[i] / 2, height / 2
        qx = np.abs(along - edges[i] - half_x) - half_x + corner_m
        qy = np.abs(across[here] - half_y) - half_y + corner_m
        outside = np.hypot(np.maximum(qx, 0), np.maximum(qy, 0))
        distance[here] = corner_m - outside - np.minimum(np.maximum(qx, qy), 0)
        number[here] = first + i
        first += len(widths)
    return distance, number


def per_stone(number, seed):
    """A random number 0..1 for each stone."""
    return np.random.RandomState(seed).rand(number.max() + 1).astype(np.float32)[number]


def random_widths(rng, size_m, count, spread):
    widths = rng.uniform(1.0 - spread, 1.0 + spread, count)
    return list(widths / widths.sum() * size_m)


def paving():
    """Flags in panels of 2.4 m between bands of dark setts."""
    shape, size = (1024, 1024), (2.4, 2.4)
    rng = np.random.RandomState(11)
    band = [PAVING_BAND_M / 2] * 2
    rows = [(0.0, band + random_widths(rng, 2.4 - PAVING_BAND_M, 5 + r % 2, 0.25))
            for r in range(6)]
    edge, stone = courses(shape, size, rows, 0.018, 0.002, 12, (2.4 - PAVING_BAND_M) / 6)
    small = [(0.0, [PAVING_BAND_M / 2] * 24)] * 24
    sett_edge, sett = courses(shape, size, small, 0.016, 0.0015, 18)
    x, y = metres(shape, size)
    in_band = (x < PAVING_BAND_M) | (y > 2.4 - PAVING_BAND_M)
    edge = np.where(in_band, sett_edge, edge)
    inside, worn = step(0.003, 0.010, edge), step(0.004, 0.045, edge)
    fine, mid = noise(shape, 60, 400, 0.6, 13), noise(shape, 3, 60, 1.1, 14)
    tone = per_stone(stone, 15)
    colour = palette(["a88f68", "c4ab80", "d2bd96", "dfcfac"], tone + 0.06 * mid)
    colour = mix(colour, rgb("b9a896"), 0.75 * step(0.80, 0.86, per_stone(stone, 16)))
    colour = mix(colour, rgb("c69a6a"), 0.55 * step(0.12, 0.06, per_stone(stone, 16)))
    dark = palette(["48423c", "605850", "70665a"], per_stone(sett, 19) + 0.06 * mid)
    colour = np.where(in_band[..., None], dark, colour)
    pits = step(1.3, 2.2, noise(shape, 20, 120, 0.5, 17))
    colour = colour * (1 + 0.05 * fine + 0.05 * mid - 0.22 * pits)[..., None]
    colour = colour * (0.80 + 0.20 * worn)[..., None]
    joint = mix(rgb("4f4430"), rgb("5f6238"), step(0.0, 1.5, mid)) * (1 + 0.12 * fine)[..., None]
    height = (0.008 * step(0.0, 0.022, edge) +
              (0.0007 * mid + 0.0002 * fine - 0.0016 * pits) * inside)
    return mix(joint, colour, inside), height, 1024 / 2.4


def setts():
    shape, size = (512, 512), (1.0, 1.0)
    rng = np.random.RandomState(21)
    rows = [(rng.uniform(0, 0.1), random_widths(rng, 1.0, 8, 0.18)) for _ in range(8)]
    edge, stone = courses(shape, size, rows, 0.024, 0.0025, 22)
    inside = step(0.003, 0.010, edge)
    fine, mid = noise(shape, 40, 250, 0.5, 23), noise(shape, 3, 40, 1.0, 24)
    colour = palette(["6a625c", "857b70", "9c9182"], per_stone(stone, 25) + 0.05 * mid)
    colour = mix(colour, rgb("8a6a58"), 0.5 * step(0.85, 0.92, per_stone(stone, 26)))
    colour = (colour * (1 + 0.07 * fine)[..., None] *
              (0.72 + 0.34 * step(0.0, 0.04, edge))[..., None])
    joint = rgb("4a4334") * (1 + 0.12 * fine)[..., None]
    return mix(joint, colour, inside), 0.012 * step(0, 0.035, edge) + 0.0005 * fine, 512.0


def ashlar():
    shape, size = (1024, 1024), (2.0, 2.0)
    rng = np.random.RandomState(31)
    rows = [(rng.uniform(0, 2.0), random_widths(rng, 2.0, 3, 0.28)) for _ in range(5)]
    edge, stone = courses(shape, size, rows, 0.012, 0.0012, 32)
    inside = step(0.002, 0.008, edge)
    fine, mid = noise(shape, 60, 400, 0.6, 33), noise(shape, 2, 60, 1.2, 34)
    strata = noise(shape, 4, 200, 0.9, 35, stretch=(6.0, 1.0))
    colour = palette(["c2a87c", "d4bd92", "e2d0aa", "e9dcbc"], per_stone(stone, 36) + 0.07 * mid)
    colour = mix(colour, rgb("d6ac78"), 0.45 * step(0.75, 0.95, per_stone(stone, 37)))
    pits = step(1.4, 2.4, noise(shape, 24, 140, 0.4, 38))
    colour = colour * (1 + 0.035 * fine + 0.03 * strata - 0.25 * pits)[..., None]
    colour = colour * (0.88 + 0.12 * step(0.0, 0.04, edge))[..., None]
    joint = rgb("a08a66") * (1 + 0.06 * fine)[..., None]
    height = 0.009 * step(0, 0.024, edge) + (0.0012 * mid + 0.0004 * strata - 0.003 * pits) * inside
    return mix(joint, colour, inside), height, 512.0


def carved():
    shape = (512, 512)
    fine, mid = noise(shape, 40, 250, 0.6, 41), noise(shape, 1, 40, 1.3, 42)
    vein = np.exp(-np.square(noise(shape, 1, 24, 1.4, 43) * 7.0))
    colour = palette(["c9b48c", "ddccaa", "e8dcc0"], 0.55 + 0.2 * mid)
    pits = step(1.6, 2.6, noise(shape, 16, 90, 0.4, 44))
    colour = colour * (1 + 0.03 * fine - 0.07 * vein - 0.2 * pits)[..., None]
    return colour, 0.0008 * mid + 0.0002 * fine - 0.0018 * pits, 512.0


def plaster():
    shape = (512, 512)
    fine, mid = noise(shape, 60, 250, 0.4, 51), noise(shape, 3, 60, 1.2, 52)
    large = noise(shape, 1, 6, 1.0, 53)
    rain = noise(shape, 3, 60, 0.8, 54, stretch=(1.0, 9.0))
    colour = palette(["c8843e", "dc9c50", "e6ac62", "efc07c"], 0.5 + 0.13 * mid + 0.13 * large)
    colour = colour * (1 + 0.022 * fine - 0.045 * np.maximum(rain, 0))[..., None]
    bare = noise(shape, 2, 80, 1.35, 55)
    patch, rim = step(2.15, 2.25, bare), step(1.95, 2.15, bare)
    colour = mix(colour, rgb("d9c39c") * (1 + 0.05 * fine)[..., None], 0.8 * patch)
    colour = colour * (1 - 0.12 * (rim - patch))[..., None]
    return colour, 0.0016 * mid + 0.0004 * fine - 0.006 * patch, 512 / 4.0


def brick():
    shape, size = (512, 512), (2.0, 2.0)
    rows = [(0.125 * (r % 2), [0.25] * 8) for r in range(26)]
    edge, stone = courses(shape, size, rows, 0.006, 0.0012, 61)
    inside = step(0.002, 0.007, edge)
    fine, mid = noise(shape, 60, 250, 0.4, 62), noise(shape, 2, 40, 1.1, 63)
    colour = palette(["8e4a34", "a95a3c", "bf6e48", "cf8a5e"], per_stone(stone, 64) + 0.07 * mid)
    colour = mix(colour, rgb("6e3e34"), 0.7 * step(0.90, 0.96, per_stone(stone, 65)))
    colour = colour * (1 + 0.07 * fine)[..., None]
    mortar = rgb("c4b08c") * (1 + 0.05 * fine + 0.04 * mid)[..., None]
    return mix(mortar, colour, inside), 0.008 * step(0.0, 0.010, edge) + 0.0004 * fine, 256.0


def roof():
    """Mission tiles, one metre of four ridges and four gutters, four courses up the slope."""
    shape = (512, 512)
    x, y = metres(shape, (1.0, 1.6))
    column = np.floor(x * 8).astype(int)  # even: covers, odd: pans
    along = y / 0.4 + 0.5 * (column % 2)
    course = np.floor(along).astype(int) % 4
    down = along - np.floor(along)  # 0 under the tile above .. 1 at the lower rim
    tile = column * 4 + course
    fine, mid = noise(shape, 40, 250, 0.5, 71), noise(shape, 2, 40, 1.1, 72)
    colour = palette(["9c4f30", "b9613a", "cd7a4a", "dc9866"], per_stone(tile, 73) + 0.07 * mid)
    colour = mix(colour, rgb("e0b184"), 0.55 * step(0.82, 0.92, per_stone(tile, 74)))
    colour = mix(colour, rgb("754230"), 0.6 * step(0.14, 0.06, per_stone(tile, 74)))
    lichen = step(0.9, 2.0, noise(shape, 2, 60, 0.9, 75))
    colour = mix(colour * (1 + 0.06 * fine)[..., None], rgb("9a8f5c"), 0.4 * lichen)
    shade = (0.42 + 0.58 * step(0.0, 0.15, down)) * np.where(column % 2 == 1, 0.70, 1.0)
    shade = shade * (1 + 0.14 * step(0.90, 0.98, down))
    return colour * shade[..., None], 0.016 * down + 0.0006 * fine, 512 / 1.0


def planks(shape, size_m, count, codes, seed):
    """Boards along y; returns the colour, the boards' distance to the gaps and the grain."""
    x, _ = metres(shape, size_m)
    board = np.floor(x / size_m[0] * count).astype(int) % count
    within = x / size_m[0] * count - np.floor(x / size_m[0] * count)
    gap = np.minimum(within, 1 - within) * size_m[0] / count
    grain = noise(shape, 6, 300, 0.8, seed, stretch=(0.6, 12.0))
    shift = np.random.RandomState(seed + 1).randint(0, shape[0], count)
    for b in range(count):
        grain = np.where(board == b, np.roll(grain, shift[b], 0), grain)
    tone = per_stone(board, seed + 2)
    return palette(codes, 0.2 + 0.5 * tone + 0.13 * grain), gap, grain


def wood():
    colour, gap, grain = planks((512, 512), (1.0, 1.0), 5, ["4a2f1c", "6b4528", "8a5f38", "a37a4c"],
                                81)
    inside = step(0.002, 0.008, gap)
    return colour * (0.4 + 0.6 * inside)[..., None], 0.006 * inside + 0.0004 * grain, 512.0


def door():
    """One leaf of 1.24 x 2.45 m: planks behind a frame of three panels, with iron studs."""
    shape, size = (512, 256), (1.24, 2.45)
    colour, gap, grain = planks(shape, size, 8, ["3e2415", "57331c", "70462a", "85583a"], 91)
    inside = step(0.002, 0.008, gap)
    x, y = metres(shape, size)
    panel = np.full(shape, -1.0, np.float32)
    for top, bottom in ((0.12, 0.78), (0.92, 1.58), (1.72, 2.33)):
        for left, right in ((0.12, 0.56), (0.68, 1.12)):
            inner = np.minimum(np.minimum(x - left, right - x), np.minimum(y - top, bottom - y))
            panel = np.maximum(panel, inner)
    recess = step(0.0, 0.03, panel)
    colour = colour * (0.45 + 0.55 * np.maximum(inside, 1 - recess))[..., None]
    groove = np.exp(-np.square(panel / 0.012))
    colour = colour * (1 - 0.5 * groove)[..., None] * (1.12 - 0.12 * recess)[..., None]
    studs = np.hypot((x % 0.62) - 0.31, (y - 0.85 + 0.4) % 0.8 - 0.4) < 0.028
    colour = np.where(studs[..., None], rgb("2a2622"), colour)
    return colour, 0.012 * (1 - recess) + 0.0005 * grain + 0.004 * studs, 256 / 1.24


def shutter():
    """One leaf of 0.56 x 1.66 m: two fields of slats in a frame, worn blue-green paint."""
    shape, size = (512, 256), (0.56, 1.66)
    x, y = metres(shape, size)
    wood_colour, _, grain = planks(shape, size, 2, ["8a7252", "a88e68", "bda47e"], 101)
    field = np.full(shape, -1.0, np.float32)
    for top, bottom in ((0.09, 0.80), (0.89, 1.57)):
        field = np.maximum(
            field, np.minimum(np.minimum(x - 0.07, 0.49 - x), np.minimum(y - top, bottom - y)))
    slatted = step(0.0, 0.006, field)
    slat = (y / 0.045) % 1.0
    paint = palette(["1d5a58", "2a7470", "3a8a84"], 0.5 + 0.16 * grain)
    wear = step(1.1, 2.0, noise(shape, 4, 120, 0.8, 102, stretch=(1.0, 3.0)) + 0.5 * grain)
    colour = mix(paint, wood_colour, 0.7 * wear)
    colour = (colour * (1 - slatted *
                        (0.62 * step(0.35, 0.0, slat) - 0.12 * step(0.7, 0.9, slat)))[..., None])
    rim = np.exp(-np.square(field / 0.008))
    colour = colour * (1 - 0.45 * rim)[..., None]
    height = 0.010 * (1 - slatted) + slatted * 0.010 * slat + 0.0003 * grain
    return colour, height, 256 / 0.56


def terracotta():
    shape = (256, 256)
    fine, mid = noise(shape, 20, 120, 0.5, 111), noise(shape, 1, 20, 1.1, 112)
    colour = palette(["a8552f", "c06c40", "cf8457"], 0.5 + 0.2 * mid)
    salt = step(0.8, 2.2, noise(shape, 1, 30, 1.1, 113))
    colour = mix(colour, rgb("dcb898"), 0.35 * salt) * (1 + 0.04 * fine)[..., None]
    return colour, 0.0006 * mid + 0.0002 * fine, 256.0


def glass():
    """A pane of 0.5 m with a curtain behind it and the sky in its upper half."""
    shape = (128, 128)
    x, y = metres(shape, (1.0, 1.0))
    fold = 0.5 + 0.5 * np.sin(x * 2 * np.pi * 5 + np.sin(x * 2 * np.pi * 2))
    colour = mix(rgb("26303a"), rgb("8a8478"), 0.28 * fold)
    sky = step(0.75, 0.05, y + 0.15 * np.sin(x * 2 * np.pi)) + 0.10 * noise(shape, 1, 6, 1.0, 121)
    return mix(colour, rgb("8fb4d4"), np.clip(0.5 * sky, 0, 1)), None, 0.0


def water():
    shape = (256, 256)
    waves = noise(shape, 2, 24, 1.3, 131) + 0.5 * noise(shape, 3, 12, 1.0, 132)
    colour = palette(["0f2f33", "17444a", "22585a", "3a7673"], 0.45 + 0.15 * waves)
    return colour, 0.0022 * waves, 128.0


def sky():
    """Red and green displace the clouds, blue is cloud. As it is, the picture looks like a sky.

    Blue is 0.77 in the clear and 1 in the densest cloud. Red and green hold a swirl of their own
    (deviation 0.012) on top of a part that follows the cloud (0.40 to 0.93 and 0.57 to 0.94).
    """
    shape = (512, 512)
    billow = noise(shape, 2, 160, 1.55, 141) + 0.55 * noise(shape, 1, 3, 0.6, 142)
    cloud = step(-0.15, 1.9, billow)
    swirl_x, swirl_y = noise(shape, 1, 12, 1.2, 143), noise(shape, 1, 12, 1.2, 144)
    red = 0.40 + 0.53 * cloud + 0.012 * swirl_x
    green = 0.57 + 0.37 * cloud + 0.012 * swirl_y
    return np.stack([red, green, 0.77 + 0.23 * cloud], -1), None, 0.0


# name: (maker, quality, times the normal map is halved; None: no normal map is shipped)
TEXTURES = {
    "paving": (paving, 84, None),
    "setts": (setts, 84, 0),
    "ashlar": (ashlar, 84, 1),
    "carved": (carved, 84, None),
    "plaster": (plaster, 86, None),
    "brick": (brick, 84, None),
    "roof": (roof, 84, None),
    "wood": (wood, 84, None),
    "door": (door, 86, None),
    "shutter": (shutter, 86, None),
    "terracotta": (terracotta, 86, None),
    "glass": (glass, 86, None),
    "water": (water, 88, 0),
    "sky": (sky, 92, None),
}


def make(folder, name):
    maker, quality, halvings = TEXTURES[name]
    colour, height, texels_per_m = maker()
    save_jpeg(folder / f"{name}.jpg", colour, quality)
    if halvings is not None:
        for _ in range(halvings):
            height, texels_per_m = halved(height), texels_per_m / 2
        save_jpeg(folder / f"{name}_n.jpg", normal_map(height, texels_per_m), 85)


if __name__ == "__main__":
    for wanted in sys.argv[2:] or TEXTURES:
        make(pathlib.Path(sys.argv[1]), wanted)
