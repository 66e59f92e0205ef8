"""Makes glazed tiles as a DDS texture in BC1, with all its mip levels."""
import struct

import numpy as np

SIDE = 128


def linear(code):
    c = np.asarray(code, float) / 255
    return np.where(c <= 0.04045, c / 12.92, ((c + 0.055) / 1.055)**2.4)


def encoded(light):
    light = np.clip(light, 0, 1)
    return 255 * np.where(light <= 0.0031308, 12.92 * light, 1.055 * light**(1 / 2.4) - 0.055)


def tiles():
    """Four by four tiles: a blue star on a pale ground, with joints between them. It repeats."""
    rng = np.random.default_rng(3)
    y, x = np.mgrid[0:SIDE, 0:SIDE] + 0.5
    cell = SIDE / 4
    u, v = (x % cell) / cell - 0.5, (y % cell) / cell - 0.5
    angle, radius = np.arctan2(v, u), np.hypot(u, v)
    star = np.clip((0.30 + 0.10 * np.cos(8 * angle) - radius) * 24 + 0.5, 0, 1)[..., None]
    ring = np.clip(1.5 - abs(radius - 0.44) * 40, 0, 1)[..., None]
    tone = rng.uniform(0.88, 1.05, (4, 4))[(y // cell).astype(int), (x // cell).astype(int)]
    ground = np.array([232, 224, 204]) * np.ones((SIDE, SIDE, 1))
    rgb = ground * (1 - star) + np.array([38, 84, 150]) * star
    rgb = rgb * (1 - 0.7 * ring) + np.array([186, 92, 48]) * 0.7 * ring
    rgb = rgb * tone[..., None]
    joint = (np.maximum(abs(u), abs(v)) > 0.47)[..., None]
    return np.clip(np.where(joint, np.array([120, 112, 104]), rgb), 0, 255)


def levels(rgb):
    """Halves the picture in linear light down to 1x1."""
    result = [rgb]
    light = linear(rgb)
    while light.shape[0] > 1:
        light = light.reshape(light.shape[0] // 2, 2, -1, 2, 3).mean((1, 3))
        result.append(encoded(light))
    return result


def pack_565(colour):
    r, g, b = np.rint(np.asarray(colour) * np.array([31, 63, 31]) / 255).astype(int)
    return int(r << 11 | g << 5 | b)


def unpack_565(value):
    return np.array([(value >> 11) / 31, (value >> 5 & 63) / 63, (value & 31) / 31]) * 255


def block(texels):
    """Encodes 16 colours: the ends of the line through their longest axis, and the nearest choices."""
    mean = texels.mean(0)
    _, _, axes = np.linalg.svd(texels - mean, full_matrices=False)
    along = (texels - mean) @ axes[0]
    ends = [pack_565(np.clip(mean + t * axes[0], 0, 255)) for t in (along.max(), along.min())]
    a, b = max(ends), min(ends)
    if a == b:
        return struct.pack("<2HI", a, b, 0)
    first, second = unpack_565(a), unpack_565(b)
    palette = np.array([first, second, (2 * first + second) / 3, (first + 2 * second) / 3])
    choices = ((texels[:, None] - palette)**2).sum(2).argmin(1)
    return struct.pack("<2HI", a, b, sum(int(c) << 2 * i for i, c in enumerate(choices)))


def compress(rgb):
    """Small levels are padded to whole blocks by repeating their last texels."""
    side = max(4, rgb.shape[0])
    rows = np.minimum(np.arange(side), rgb.shape[0] - 1)
    rgb = rgb[rows][:, rows]
    return b"".join(block(rgb[y:y + 4, x:x + 4].reshape(16, 3))
                    for y in range(0, side, 4) for x in range(0, side, 4))


def dds(rgb):
    chain = levels(rgb)
    header = struct.pack("<4s7I44x", b"DDS ", 124, 0xA1007, SIDE, SIDE, SIDE * SIDE // 2, 0,
                         len(chain))
    header += struct.pack("<2I4s5I", 32, 4, b"DXT1", 0, 0, 0, 0, 0)
    header += struct.pack("<5I", 0x401008, 0, 0, 0, 0)
    return header + b"".join(compress(level) for level in chain)
