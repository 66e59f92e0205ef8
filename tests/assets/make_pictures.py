#!/usr/bin/python3
"""Makes the pictures in data/pictures, and what other programs read from them.

Needs (Debian): python3-numpy python3-pil imagemagick

For each picture NAME, NAME.rgba holds the expected texels, 4 bytes each. For DDS files, they are
those of all levels, as PIL decodes them (of level 0 only, for the file that ImageMagick writes). For PCX, PPM and PGM files, they are the texels that PIL
or ImageMagick was told to write. test_picture_formats.c lists the files.
"""
import io
import pathlib
import struct
import subprocess

import numpy as np
from PIL import Image

FOLDER = pathlib.Path(__file__).parent / "data" / "pictures"
RNG = np.random.default_rng(20261122)


def save(name, data, rgba):
    (FOLDER / name).write_bytes(data)
    (FOLDER / (name + ".rgba")).write_bytes(np.asarray(rgba, np.uint8).tobytes())


def dds(width, height, levels, fourcc=b"", bits=0, masks=(0, 0, 0, 0), dxgi=None, flags=None):
    """levels: the bytes of each level."""
    if flags is None:
        flags = 4 if fourcc else 0x41
    header = struct.pack("<4s7I44x", b"DDS ", 124, 0x21007, height, width, 0, 0, len(levels))
    header += struct.pack("<2I4s5I", 32, flags, fourcc, bits, *masks)
    header += struct.pack("<5I", 0x401008, 0, 0, 0, 0)
    assert len(header) == 128
    if dxgi is not None:
        header += struct.pack("<5I", dxgi, 3, 0, 1, 0)
    return header + b"".join(levels)


def sizes(width, height, count):
    return [(max(1, width >> level), max(1, height >> level)) for level in range(count)]


def pil_rgba(data):
    return Image.open(io.BytesIO(data)).convert("RGBA").tobytes()


def compressed(name, fourcc, block_bytes, width, height, count, dxgi=None, pil_fourcc=None):
    """Blocks of random bytes use every mode of a format. PIL reads only level 0, so it is given a
    file for each level. It reads whole blocks only, so such a file is as large as the blocks."""
    levels = []
    texels = b""
    for w, h in sizes(width, height, count):
        across, down = (w + 3) // 4, (h + 3) // 4
        levels.append(RNG.bytes(across * down * block_bytes))
        alone = dds(4 * across, 4 * down, [levels[-1]], pil_fourcc or fourcc)
        decoded = np.frombuffer(pil_rgba(alone), np.uint8).reshape(4 * down, 4 * across, 4)
        texels += decoded[:h, :w].tobytes()
    data = dds(width, height, levels, fourcc, dxgi=dxgi)
    save(name, data, np.frombuffer(texels, np.uint8))


def uncompressed(name, masks, bits, width, height, count, flags):
    """Every channel with 8 bits or none, so the texels are exact."""
    levels = []
    texels = []
    for w, h in sizes(width, height, count):
        rgba = RNG.integers(0, 256, (h, w, 4)).astype(np.uint32)
        packed = np.zeros((h, w), np.uint64)
        for k in range(4):
            if masks[k]:
                shift = (masks[k] & -masks[k]).bit_length() - 1
                packed |= rgba[..., k].astype(np.uint64) << np.uint64(shift)
        if not masks[3]:
            rgba[..., 3] = 255
        if not masks[1]:
            rgba[..., 1] = rgba[..., 2] = rgba[..., 0]
        levels.append(packed.astype("<u8").view(np.uint8).reshape(h, w, 8)[..., :bits // 8].tobytes())
        texels.append(rgba.astype(np.uint8).tobytes())
    save(name, dds(width, height, levels, bits=bits, masks=masks, flags=flags),
         np.frombuffer(b"".join(texels), np.uint8))


def picture(mode, width=13, height=10):
    y, x = np.mgrid[0:height, 0:width]
    rgb = np.stack([20 * x, 25 * y, 255 - 19 * x], -1).astype(np.uint8)
    rgb[2:4] = (200, 40, 192)  # long runs, and values that need a run of 1 in PCX
    image = Image.fromarray(rgb, "RGB")
    if mode == "P":
        return image.quantize(16 if width < 10 else 64)
    return image.convert(mode)


def pcx_and_pnm():
    for mode, name in (("1", "black_white.pcx"), ("L", "grey.pcx"), ("P", "palette.pcx"),
                       ("RGB", "colours.pcx")):
        image = picture(mode)
        data = io.BytesIO()
        image.save(data, "PCX")
        save(name, data.getvalue(), np.array(image.convert("RGBA")))
    for mode, name in (("L", "grey.pgm"), ("RGB", "colours.ppm")):
        image = picture(mode)
        data = io.BytesIO()
        image.save(data, "PPM")
        save(name, data.getvalue(), np.array(image.convert("RGBA")))


def magick(source, *arguments):
    png = io.BytesIO()
    source.save(png, "PNG")
    return subprocess.run(["convert", "png:-", *arguments], input=png.getvalue(), check=True,
                          capture_output=True).stdout


def by_imagemagick():
    image = picture("RGB")
    rgba = np.array(image.convert("RGBA"))
    save("text.ppm", magick(image, "-compress", "none", "ppm:-"), rgba)
    save("deep.ppm", magick(image, "-depth", "16", "ppm:-"), rgba)
    save("magick.pcx", magick(image, "pcx:-"), rgba)
    small = picture("RGB", 5, 4)
    (FOLDER / "flat.hdr").write_bytes(magick(small, "-colorspace", "RGB", "hdr:-"))
    data = magick(picture("RGB", 16, 16), "-define", "dds:compression=dxt1", "-define",
                  "dds:mipmaps=4", "dds:-")
    save("magick_bc1.dds", data, np.frombuffer(pil_rgba(data), np.uint8))


def light(width=40, height=9):
    """An HDR file with runs of all lengths, and with light far above and below 1. ImageMagick would
    cut off light above 1. The test reads it with stb_image, too."""
    data = b"#?RADIANCE\n# made by make_pictures.py\nFORMAT=32-bit_rle_rgbe\nEXPOSURE=2\n\n"
    data += b"-Y %d +X %d\n" % (height, width)
    for y in range(height):
        data += bytes([2, 2, width >> 8, width & 255])
        for channel in range(4):
            x = 0
            while x < width:
                count = int(min(RNG.integers(1, 14), width - x))
                low, high = (118, 134) if channel == 3 else (0, 256)
                if RNG.random() < 0.4:
                    data += bytes([128 + count, int(RNG.integers(low, high))])
                else:
                    data += bytes([count, *RNG.integers(low, high, count).tolist()])
                x += count
    (FOLDER / "light.hdr").write_bytes(data)


def main():
    FOLDER.mkdir(parents=True, exist_ok=True)
    compressed("bc1.dds", b"DXT1", 8, 13, 10, 4)
    compressed("bc2.dds", b"DXT3", 16, 8, 4, 4)
    compressed("bc3.dds", b"DXT5", 16, 13, 10, 1)
    compressed("bc3_dx10.dds", b"DX10", 16, 8, 8, 1, dxgi=77, pil_fourcc=b"DXT5")
    uncompressed("bgra.dds", (0xff0000, 0xff00, 0xff, 0xff000000), 32, 6, 5, 3, 0x41)
    uncompressed("bgr.dds", (0xff0000, 0xff00, 0xff, 0), 24, 5, 3, 1, 0x40)
    uncompressed("bgrx.dds", (0xff0000, 0xff00, 0xff, 0), 32, 5, 3, 1, 0x40)
    uncompressed("rgba.dds", (0xff, 0xff00, 0xff0000, 0xff000000), 32, 4, 4, 3, 0x41)
    uncompressed("luminance.dds", (0xff, 0, 0, 0), 8, 5, 3, 1, 0x20000)
    uncompressed("luminance_alpha.dds", (0xff, 0, 0, 0xff00), 16, 5, 3, 1, 0x20001)
    pcx_and_pnm()
    light()
    by_imagemagick()


if __name__ == "__main__":
    main()
