#!/usr/bin/env python3
"""Makes the pictures with a clip map: the iron fence and the leaf and flower cards (*.png).

Usage: cards.py FOLDER
"""
import math
import pathlib
import random
import sys

import numpy as np
from PIL import Image, ImageDraw

from noise import noise, palette, rgb, save_clip_map

SUPERSAMPLING = 4


def reduced(field):
    """The mean of each block of SUPERSAMPLING x SUPERSAMPLING texels."""
    n = SUPERSAMPLING
    shape = (field.shape[0] // n, n, field.shape[1] // n, n) + field.shape[2:]
    return field.reshape(shape).mean((1, 3))


class Ironwork:
    """Round iron bars seen from the front: their brightness, and where there is iron."""

    def __init__(self, width_m, height_m, texels_per_m):
        rows, columns = round(height_m * texels_per_m), round(width_m * texels_per_m)
        y, x = np.mgrid[0:rows, 0:columns].astype(np.float32)
        self.x, self.z = (x + 0.5) / texels_per_m, height_m - (y + 0.5) / texels_per_m
        self.width = width_m
        self.there = np.zeros((rows, columns), bool)
        self.light = np.zeros((rows, columns), np.float32)

    def across(self, x):
        """Distance in x, which wraps around with the picture."""
        return (self.x - x + self.width / 2) % self.width - self.width / 2

    def lay(self, inside, lean):
        """lean: -1..1, which way the iron's surface faces. Light comes from the upper left."""
        self.there |= inside
        lean = np.clip(lean, -1, 1)
        light = 0.30 + 0.55 * np.clip(0.8 * np.sqrt(1 - lean * lean) - 0.6 * lean, 0, 1)
        self.light = np.where(inside, light, self.light)

    def turned(self, x, profile):
        """An upright bar; profile: (height, half its width)."""
        z, half = zip(*profile)
        width = np.interp(self.z, z, half)
        dx = self.across(x)
        inside = (np.abs(dx) < width) & (self.z > z[0]) & (self.z < z[-1])
        self.lay(inside, dx / np.maximum(width, 1e-4))

    def rail(self, z, half):
        self.lay(np.abs(self.z - z) < half, -(self.z - z) / half)

    def ring(self, x, z, radius, half):
        dx, dz = self.across(x), self.z - z
        off = np.hypot(dx, dz) - radius
        self.lay(np.abs(off) < half, off / half * np.where(dx - dz > 0, 1, -1))


def fence():
    """The fence: two metres square, with a bar every 0.125 m."""
    iron = Ironwork(0.25, 2.0, 512 * SUPERSAMPLING)
    for x in (0.0625, 0.1875):
        iron.turned(x, [(0.02, 0.009), (1.76, 0.009), (1.77, 0.018), (1.79, 0.018), (1.80, 0.009),
                        (1.815, 0.010), (1.85, 0.024), (1.87, 0.022), (1.985, 0.0015)])
        iron.turned(x, [(0.955, 0.010), (0.985, 0.017), (1.015, 0.017), (1.045, 0.010)])
    for x in (0.0, 0.125):
        iron.turned(x, [(0.06, 0.008), (0.52, 0.008), (0.545, 0.018), (0.555, 0.017),
                        (0.63, 0.001)])
        iron.ring(x, 1.545, 0.052, 0.008)
    for z, half in ((0.06, 0.020), (0.40, 0.013), (1.46, 0.014), (1.63, 0.018)):
        iron.rail(z, half)
    alpha = np.tile(reduced(iron.there.astype(np.float32)), (1, 8))
    light = np.tile(reduced(iron.light * iron.there), (1, 8)) / np.maximum(alpha, 1e-3)
    rust = np.clip(noise(alpha.shape, 4, 120, 1.0, 7) - 1.2, 0, 1)[..., None]
    colour = palette(["0c0f10", "23292a", "4a5452"], light) * (1 - rust) + rgb("5a3420") * rust
    return colour, alpha


def leaf_outline(base, angle, length, width, bend):
    """The two halves of a leaf, as polygons around the same midrib."""
    stations = [(0.0, 0.0), (0.12, 0.32), (0.3, 0.48), (0.5, 0.5), (0.7, 0.38), (0.88, 0.16),
                (1.0, 0.0)]
    rib, left, right = [], [], []
    for t, w in stations:
        a = angle + bend * t
        x = base[0] + math.cos(angle + bend * t / 2) * length * t
        y = base[1] + math.sin(angle + bend * t / 2) * length * t
        rib.append((x, y))
        left.append((x - math.sin(a) * w * width, y + math.cos(a) * w * width))
        right.append((x + math.sin(a) * w * width, y - math.cos(a) * w * width))
    return rib, left, right


class Spray:
    """A card on which leaves and petals are painted. Those in the shade come first."""

    def __init__(self, size_px, seed):
        self.size = size_px * SUPERSAMPLING
        self.colour = Image.new("RGB", (self.size, self.size))
        self.alpha = Image.new("L", (self.size, self.size))
        self.random = random.Random(seed)

    def polygon(self, points, colour):
        points = [(x * self.size, y * self.size) for x, y in points]
        ImageDraw.Draw(self.colour).polygon(points, tuple(int(255 * min(1.0, c)) for c in colour))
        ImageDraw.Draw(self.alpha).polygon(points, 255)

    def leaf(self, base, angle, length, colour):
        rib, left, right = leaf_outline(base, angle, length,
                                        length * self.random.uniform(0.40, 0.52),
                                        self.random.uniform(-0.5, 0.5))
        self.polygon(rib + left[::-1], np.asarray(colour) * 1.10)
        self.polygon(rib + right[::-1], np.asarray(colour) * 0.84)

    def petals(self, centre, radius, colour):
        turn = self.random.uniform(0, 6.28)
        for k in range(5):
            self.leaf(centre, turn + k * 2 * math.pi / 5, radius,
                      np.asarray(colour) * self.random.uniform(0.9, 1.1))
        dot = [(centre[0] + 0.016 * math.cos(a), centre[1] + 0.016 * math.sin(a))
               for a in (0, 1, 2, 3, 4, 5, 6)]
        self.polygon(dot, rgb("f4e6a0"))

    def places(self, margin, cells):
        """A point in each of cells x cells, at least margin from the card's edges, in any order;
        and which way is out. Cards are filled evenly and into their corners, because what is tested
        and not there costs as much as what is."""
        order = list(range(cells * cells))
        self.random.shuffle(order)
        for k in order:
            x, y = (margin + (1 - 2 * margin) * (i + self.random.random()) / cells
                    for i in divmod(k, cells))
            yield (x, y), math.atan2(y - 0.5, x - 0.5)

    def picture(self):
        alpha = reduced(np.asarray(self.alpha, np.float32) / 255.0)
        weight = np.maximum(alpha, 1e-3)[..., None]
        masked = (np.asarray(self.colour, np.float32) / 255.0 *
                  (np.asarray(self.alpha)[..., None] > 0))
        return reduced(masked) / weight, alpha


def leaves(seed, codes, cells=13):
    spray = Spray(512, seed)
    for i, (base, outwards) in enumerate(spray.places(0.11, cells)):
        depth = i / cells**2  # 0: painted first, in the shade
        tone = 0.55 * depth + 0.45 * spray.random.random()
        colour = palette(codes, np.array([tone]))[0] * (0.50 + 0.50 * depth)
        spray.leaf(base, outwards + spray.random.uniform(-0.9, 0.9),
                   spray.random.uniform(0.13, 0.195), colour)
    return spray.picture()


def flowers(seed, greens, petals):
    spray = Spray(512, seed)
    for i, (base, outwards) in enumerate(spray.places(0.11, 12)):
        colour = palette(greens, np.array([spray.random.random()]))[0] * (0.45 + 0.35 * i / 144)
        spray.leaf(base, outwards + spray.random.uniform(-0.9, 0.9),
                   spray.random.uniform(0.12, 0.17), colour)
    for i, (centre, _) in enumerate(spray.places(0.08, 8)):
        colour = palette(petals, np.array([spray.random.random()]))[0] * (0.62 + 0.38 * i / 64)
        spray.petals(centre, spray.random.uniform(0.058, 0.088), colour)
    return spray.picture()


if __name__ == "__main__":
    folder = pathlib.Path(sys.argv[1])
    greens = ["2c5a1c", "467a28", "6a9a38", "92b850"]
    save_clip_map(folder / "fence.png", *fence(), colours=48)
    save_clip_map(folder / "leaf.png", *leaves(3, greens), colours=64)
    save_clip_map(folder / "flower.png",
                  *flowers(4, greens[:3], ["b01858", "d83078", "ee5c98", "f48cb4"]),
                  colours=96)
