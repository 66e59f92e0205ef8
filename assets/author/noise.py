"""Periodic noise and small helpers for pictures. Every texture is made with them.

All fields are n x m float32 arrays that repeat without a seam. Row 0 is the picture's upper edge.
"""
import numpy as np
from PIL import Image


def noise(shape, low, high, slope=1.0, seed=0, stretch=(1.0, 1.0)):
    """Gaussian noise of mean 0 and deviation 1 with frequencies low..high in cycles per tile.

    slope: amplitude falls with frequency to this power. stretch: (x, y) lengthens the grain.
    Made in the frequency domain, so it is exactly periodic.
    """
    rows, columns = shape
    white = np.random.RandomState(seed).standard_normal(shape)
    fx = np.fft.fftfreq(columns)[None, :] * columns * stretch[0]
    fy = np.fft.fftfreq(rows)[:, None] * rows * stretch[1]
    f = np.hypot(fx, fy)
    band = np.where((f >= low) & (f <= high), np.maximum(f, 1e-6)**-slope, 0.0)
    field = np.real(np.fft.ifft2(np.fft.fft2(white) * band))
    return (field / field.std()).astype(np.float32)


def blur(field, sigma_px):
    """Gaussian blur that wraps around."""
    rows, columns = field.shape[:2]
    fx = np.fft.fftfreq(columns)[None, :]
    fy = np.fft.fftfreq(rows)[:, None]
    gauss = np.exp(-2.0 * (np.pi * sigma_px)**2 * (fx * fx + fy * fy))
    if field.ndim == 3:
        return np.stack([blur(field[..., c], sigma_px) for c in range(field.shape[2])], -1)
    return np.real(np.fft.ifft2(np.fft.fft2(field) * gauss)).astype(np.float32)


def step(low, high, x):
    """0 below low, 1 above high, smooth between."""
    t = np.clip((x - low) / (high - low), 0.0, 1.0)
    return t * t * (3.0 - 2.0 * t)


def rgb(code):
    """'c8a070' as three floats 0..1."""
    return np.array([int(code[i:i + 2], 16) / 255.0 for i in (0, 2, 4)], np.float32)


def mix(a, b, t):
    """Blends from a to b, each a colour or a picture, by the field t."""
    a, b = np.asarray(a, np.float32), np.asarray(b, np.float32)
    return a + (b - a) * np.asarray(t, np.float32)[..., None]


def palette(codes, t):
    """The colour at t (0..1) of a smooth ramp through the colours."""
    stops = np.stack([rgb(code) for code in codes])
    at = np.clip(t, 0.0, 1.0) * (len(stops) - 1)
    i = np.minimum(at.astype(int), len(stops) - 2)
    return mix(stops[i], stops[i + 1], at - i)


def normal_map(height_m, texels_per_m):
    """Tangent-space normals (x right, y up, z out; n * 0.5 + 0.5) of a height field in metres."""
    right = (np.roll(height_m, -1, 1) - np.roll(height_m, 1, 1)) * 0.5 * texels_per_m
    up = (np.roll(height_m, 1, 0) - np.roll(height_m, -1, 0)) * 0.5 * texels_per_m
    n = np.stack([-right, -up, np.ones_like(height_m)], -1)
    return n / np.linalg.norm(n, axis=-1, keepdims=True) * 0.5 + 0.5


def halved(picture):
    """Halves the width and height. Each texel is the mean of four."""
    p = np.asarray(picture, np.float32)
    return (p[0::2, 0::2] + p[1::2, 0::2] + p[0::2, 1::2] + p[1::2, 1::2]) / 4.0


def to_bytes(picture):
    return np.rint(np.clip(picture, 0.0, 1.0) * 255.0).astype(np.uint8)


def save_jpeg(path, picture, quality=88):
    # No chroma subsampling, because some pictures store numbers and others have sharp edges.
    Image.fromarray(to_bytes(picture)).save(path, quality=quality, subsampling=0, optimize=True)


def save_clip_map(path, colour, alpha, colours=96):
    """A palette PNG: the colours where alpha is at least one half, else one transparent entry in
    their mean, so that filtering draws no dark rim."""
    kept = alpha >= 0.5
    bytes_rgb = to_bytes(colour)
    mean = bytes_rgb[kept].mean(0)
    bytes_rgb[~kept] = np.rint(mean)
    flat = Image.fromarray(bytes_rgb).quantize(colours,
                                               method=Image.Quantize.MEDIANCUT,
                                               dither=Image.Dither.NONE)
    index = np.asarray(flat).copy()
    entries = np.array(flat.getpalette()[:3 * colours]).reshape(-1, 3).tolist()
    index[~kept] = len(entries)
    entries.append([int(round(v)) for v in mean])
    result = Image.fromarray(index, "P")
    result.putpalette([v for entry in entries for v in entry])
    result.save(path, transparency=bytes([255] * (len(entries) - 1) + [0]), optimize=True)
