#!/usr/bin/env python3
"""Runs `diptych compare` on small pictures and computes its figures anew.

    compare.py DIPTYCH
"""
import json
import math
import pathlib
import random
import struct
import subprocess
import sys
import tempfile
import zlib

DIPTYCH = pathlib.Path(sys.argv[1]).resolve()
WIDTH, HEIGHT = 40, 30


def write_ppm(path, width, height, codes):
    path.write_bytes(b"P6\n%d %d\n255\n" % (width, height) + bytes(codes))


def read_png(path):
    """Returns the codes of a PNG file with 8-bit RGB pixels."""
    data, at, packed, width = path.read_bytes(), 8, b"", 0
    while at < len(data):
        length, kind = struct.unpack(">I4s", data[at:at + 8])
        if kind == b"IHDR":
            width, height, depth, colour = struct.unpack(">IIBB", data[at + 8:at + 18])
            assert (depth, colour) == (8, 2)
        if kind == b"IDAT":
            packed += data[at + 8:at + 8 + length]
        at += 12 + length
    raw, before, codes = zlib.decompress(packed), bytearray(3 * width), []
    for y in range(height):
        start = y * (3 * width + 1)
        filtered, row = raw[start], bytearray(raw[start + 1:start + 1 + 3 * width])
        for i in range(3 * width):
            left = row[i - 3] if i >= 3 else 0
            corner = before[i - 3] if i >= 3 else 0
            guess = left + before[i] - corner
            near = min((left, before[i], corner), key=lambda v: abs(guess - v))
            add = (0, left, before[i], (left + before[i]) // 2, near)[filtered]
            row[i] = (row[i] + add) & 255
        codes += row
        before = row
    return width, height, codes


def light(code):
    c = code / 255
    return c / 12.92 if c <= .04045 else ((c + .055) / 1.055) ** 2.4


def run(*arguments, code=0):
    done = subprocess.run([DIPTYCH, "compare", *map(str, arguments)], capture_output=True,
                          text=True)
    assert done.returncode == code, (arguments, done)
    if code == 2:
        assert done.stderr.count("\n") == 1 and not done.stdout, done
    return done


def compared(*arguments):
    return json.loads(run(*arguments, "--json").stdout)


def figures_are_those_of_the_pictures(folder):
    dice = random.Random(5)
    a = [dice.randrange(256) for _ in range(3 * WIDTH * HEIGHT)]
    b = [min(255, max(0, v + dice.choice((0, 0, 0, -9, 4, 30)))) for v in a]
    write_ppm(folder / "a.ppm", WIDTH, HEIGHT, a)
    write_ppm(folder / "b.ppm", WIDTH, HEIGHT, b)
    found = compared(folder / "a.ppm", folder / "b.ppm")
    count = len(a)
    mean = sum((x - y) ** 2 for x, y in zip(a, b)) / count
    rmse = math.sqrt(sum((light(x) - light(y)) ** 2 for x, y in zip(a, b)) / count)
    other = sum(a[i:i + 3] != b[i:i + 3] for i in range(0, count, 3))
    assert abs(found["psnr_db"] - 10 * math.log10(255 ** 2 / mean)) < 1e-3, found
    assert abs(found["rmse_lin"] - rmse) < 1e-5, found
    assert found["different_pixels"] == other, (found, other)
    assert found["greatest_difference"] == max(abs(x - y) for x, y in zip(a, b)), found
    assert 0 < found["flip"] < 1 and found["ssim"] < 1 and found["filter"] == "none", found
    swapped = compared(folder / "b.ppm", folder / "a.ppm")
    assert abs(swapped["flip"] - found["flip"]) < 1e-6


def equal_pictures_have_no_difference(folder):
    found = compared(folder / "a.ppm", folder / "a.ppm", "--map", folder / "map.png")
    assert found["flip"] == 0 and found["psnr_db"] is None and found["ssim"] == 1, found
    assert found["rmse_lin"] == 0 and found["different_pixels"] == 0, found
    text = run(folder / "a.ppm", folder / "a.ppm").stdout
    assert "infinite" in text and "alpha is ignored" in text, text
    width, height, codes = read_png(folder / "map.png")
    assert (width, height) == (WIDTH, HEIGHT) and len({tuple(codes[i:i + 3])
                                                       for i in range(0, len(codes), 3)}) == 1


def filters_are_applied_to_the_first(folder):
    """What is saved is what was measured, and sharpening by 0 changes nothing."""
    found = compared(folder / "a.ppm", folder / "a.ppm", "--filter", "sharpen", "--sharpness", "0",
                     "--save", folder / "same.png")
    assert found["different_pixels"] == 0, found
    assert read_png(folder / "same.png")[2] == list((folder / "a.ppm").read_bytes()[13:])
    stairs = [255 * (y > 10 + x // 7) for y in range(HEIGHT) for x in range(WIDTH)
              for _ in range(3)]
    write_ppm(folder / "stairs.ppm", WIDTH, HEIGHT, stairs)
    for name in ("fxaa", "smaa"):
        saved = folder / (name + ".png")
        found = compared(folder / "stairs.ppm", folder / "stairs.ppm", "--filter", name, "--save",
                         saved)
        assert found["edges_found"] > WIDTH and found["different_pixels"] > 10, found
        again = compared(saved, folder / "stairs.ppm")
        assert {**again, "picture": 0, "filter": 0, "edges_found": 0} == {
            **found, "picture": 0, "filter": 0, "edges_found": 0}, (found, again)
    half = [200, 100, 50] * (WIDTH // 2 * HEIGHT // 2)
    write_ppm(folder / "half.ppm", WIDTH // 2, HEIGHT // 2, half)
    for name in ("bilinear", "bicubic", "easu"):
        run(folder / "half.ppm", folder / "a.ppm", "--filter", name, "--save",
            folder / "large.png")
        assert read_png(folder / "large.png") == (WIDTH, HEIGHT, [200, 100, 50] * WIDTH * HEIGHT)


def what_cannot_be_compared_is_refused(folder):
    a, half = folder / "a.ppm", folder / "half.ppm"
    for arguments, part in (((a,), "needs two pictures but got 1"),
                            ((a, half), "has 40 x 30 pixels"),
                            ((a, half, "--filter", "easu"), "a smaller first picture"),
                            ((half, a, "--filter", "smaa"), "accepted: pictures of one size"),
                            ((a, folder / "none.png"), "none.png"),
                            ((a, a, "--filter", "sepia"), "'sepia' is not none, fxaa"),
                            ((a, a, "--sharpness", "2"), "[--sharpness]")):
        error = run(*arguments, code=2).stderr
        assert part in error, (part, error)
    (folder / "bad.png").write_bytes(b"\x89PNG\r\n\x1a\n")
    run(folder / "bad.png", a, code=2)
    error = run(a, a, "--map", folder / "missing" / "map.png", code=1).stderr
    assert "missing/map.png" in error, error


with tempfile.TemporaryDirectory() as made:
    for test in (figures_are_those_of_the_pictures, equal_pictures_have_no_difference,
                 filters_are_applied_to_the_first, what_cannot_be_compared_is_refused):
        test(pathlib.Path(made))
