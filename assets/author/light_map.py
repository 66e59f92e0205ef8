#!/usr/bin/env python3
"""Finishes the baked light: filters its noise, fills the gaps between charts and encodes it.

Usage: light_map.py BAKED.npz OUT.jpg
The filter works in the map. It mixes a texel only with texels of similar position and normal.
"""
import sys

import numpy as np

from noise import save_jpeg
from sun import LIGHT_MAP_SCALE

KERNEL = (1 / 16, 1 / 4, 3 / 8, 1 / 4, 1 / 16)


def shifted(field, dy, dx):
    return np.roll(field, (dy, dx), (0, 1))


def filtered(light, position, normal, covered, reach_m, levels):
    """Edge-avoiding a-trous wavelets. Each level reaches twice as far as the one before."""
    weight_of = covered.astype(np.float32)
    for level in range(levels):
        stride = 1 << level
        total = np.zeros_like(light)
        weights = np.zeros(light.shape[:2], np.float32)
        for i, ky in enumerate(KERNEL):
            for j, kx in enumerate(KERNEL):
                dy, dx = (i - 2) * stride, (j - 2) * stride
                apart = ((position - shifted(position, dy, dx))**2).sum(-1)
                along = np.clip((normal * shifted(normal, dy, dx)).sum(-1), 0, 1)**8
                weight = ky * kx * along * np.exp(-apart / (reach_m * stride)**2)
                weight = weight * shifted(weight_of, dy, dx)
                total += weight[..., None] * shifted(light, dy, dx)
                weights += weight
        light = np.where(covered[..., None], total / np.maximum(weights, 1e-6)[..., None], light)
    return light


def grown(light, covered, texels):
    """Grows charts into their rims, then fills the rest with ever coarser means, so that neither
    filtering nor smaller levels bring in the dark."""
    light, covered = np.where(covered[..., None], light, 0.0), covered.copy()
    sides = [(dy, dx) for dy in (-1, 0, 1) for dx in (-1, 0, 1) if (dy, dx) != (0, 0)]
    for _ in range(texels):
        total = sum(shifted(light, *s) * shifted(covered, *s)[..., None] for s in sides)
        count = sum(shifted(covered, *s).astype(np.float32) for s in sides)
        fresh = ~covered & (count > 0)
        light[fresh] = total[fresh] / count[fresh][:, None]
        covered |= fresh
    light[~covered] = light[covered].mean(0)
    return light


def encoded(light):
    x = np.clip(light / LIGHT_MAP_SCALE, 0.0, 1.0)
    return np.where(x <= 0.0031308, x * 12.92, 1.055 * np.maximum(x, 1e-9)**(1 / 2.4) - 0.055)


def main(baked_file, out):
    baked = np.load(baked_file)
    covered, normal = baked["covered"], baked["normal"]
    position = np.where(covered[..., None], baked["position"], 1e6)
    normal = normal / np.maximum(np.linalg.norm(normal, axis=-1, keepdims=True), 1e-6)
    sunlight = np.where(covered[..., None], baked["sun"], 0.0)
    ambient = np.where(covered[..., None], np.maximum(baked["all"] - baked["sun"], 0.0), 0.0)
    ambient = filtered(ambient, position, normal, covered, 0.12, 4)
    light = sunlight + ambient
    print(f"light over {LIGHT_MAP_SCALE}: {(light[covered] > LIGHT_MAP_SCALE).mean():.4%}, "
          f"mean {light[covered].mean():.2f}")
    save_jpeg(out, encoded(grown(light, covered, 8)), 92)


if __name__ == "__main__":
    main(*sys.argv[1:])
