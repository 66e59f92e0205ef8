#!/usr/bin/env python3
"""Checks a report's RMSE and PSNR with the truths that it saves: truths.py DIPTYCH FOLDER.

Computes both errors from the PFM files and from the frames of `diptych dump` by their definitions
(docs/cost-methods.md), with readers of PFM and PNG and a conversion from sRGB of its own. FOLDER is
the top of the sources, whose courtyard is drawn.
"""
import json
import math
import os
import struct
import subprocess
import sys
import tempfile
import zlib

WIDTH, HEIGHT = 64, 48
PATH, SECONDS = "AA", 24.0  # The viewpoint is the middle of the path.
BURST, FPS = 2, 30


def run(*command, **options):
    return subprocess.run([str(c) for c in command], check=True, capture_output=True, text=True,
                          **options).stdout


def read_pfm(file):
    """Returns rows of (r, g, b), the top row first."""
    with open(file, "rb") as data:
        kind, size, scale = (data.readline().strip() for _ in range(3))
        width, height = map(int, size.split())
        assert kind == b"PF" and float(scale) == -1.0 and (width, height) == (WIDTH, HEIGHT)
        values = struct.unpack(f"<{3 * width * height}f", data.read())
        assert data.read() == b""
    rows = [values[3 * width * y:3 * width * (y + 1)] for y in range(height)]
    return rows[::-1]


def paeth(a, b, c):
    p = a + b - c
    return min((abs(p - a), 0, a), (abs(p - b), 1, b), (abs(p - c), 2, c))[2]


def read_png(file):
    """Returns rows of r, g, b codes of an RGB PNG."""
    with open(file, "rb") as data:
        bytes_ = data.read()
    at, packed = 8, b""
    while at < len(bytes_):
        length, kind = struct.unpack(">I4s", bytes_[at:at + 8])
        if kind == b"IHDR":
            header = struct.unpack(">IIBB", bytes_[at + 8:at + 18])
            assert header == (WIDTH, HEIGHT, 8, 2), header
        if kind == b"IDAT":
            packed += bytes_[at + 8:at + 8 + length]
        at += 12 + length
    lines, rows = zlib.decompress(packed), []
    before = [0] * (3 * WIDTH)
    for y in range(HEIGHT):
        line = lines[y * (3 * WIDTH + 1):(y + 1) * (3 * WIDTH + 1)]
        row = []
        for i, byte in enumerate(line[1:]):
            left, up = row[i - 3] if i >= 3 else 0, before[i]
            corner = before[i - 3] if i >= 3 else 0
            add = [0, left, up, (left + up) // 2, paeth(left, up, corner)][line[0]]
            row.append((byte + add) % 256)
        rows.append(row)
        before = row
    return rows


def decode(code):
    c = code / 255.0
    return c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4


def encode(linear):
    c = min(max(linear, 0.0), 1.0)
    c = 12.92 * c if c <= 0.0031308 else 1.055 * c ** (1.0 / 2.4) - 0.055
    return math.floor(255.0 * c + 0.5)


def errors_of(folder, settings):
    """Returns RMSE and PSNR of a row over its burst."""
    squared_lin = squared_codes = count = 0
    for frame in range(BURST):
        truth = read_pfm(f"{folder}/truths/{PATH}-0-{frame}.pfm")
        index = round(SECONDS / 2 * FPS) + frame
        drawn = read_png(f"{folder}/{settings}/current_{index:04}.png")
        for truth_row, row in zip(truth, drawn):
            for value, code in zip(truth_row, row):
                squared_lin += (decode(code) - value) ** 2
                squared_codes += (code - encode(value)) ** 2
                count += 1
    return math.sqrt(squared_lin / count), 10.0 * math.log10(255.0 ** 2 / (squared_codes / count))


def main():
    diptych, top = (os.path.abspath(argument) for argument in sys.argv[1:3])
    failed = 0
    with tempfile.TemporaryDirectory() as folder:
        size = ("--size", f"{WIDTH}x{HEIGHT}")
        run(diptych, "cost", "--out", f"{folder}/report", *size, "--places", 1, "--burst", BURST,
            "--samples", 4, "--errors-only", "--combine", "none", "--pictures", "none", "--cache",
            f"{folder}/cache", "--save-truths", f"{folder}/truths", cwd=top)
        with open(f"{folder}/report/cost.json", encoding="utf-8") as file:
            report = json.load(file)
        path = [p["name"] for p in report["paths"]].index(PATH)
        first = round(SECONDS / 2 * FPS)
        for settings in ("aa=none", "aa=8"):
            run(diptych, "dump", "--out", f"{folder}/{settings}", *size, "--category", PATH,
                "--frames", f"{first}:{first + BURST}", "--current", settings, cwd=top)
            figures = [row["figures"]["all"] for row in report["rows"]
                       if row["path"] == path and row["settings"].startswith(settings + ",taa=off") and
                       row["text"] in (settings, "defaults")][0]
            rmse, psnr = errors_of(folder, settings)
            print(f"{settings}: RMSE {rmse:.8f}, report {figures['rmse_lin']:.8f}; "
                  f"PSNR {psnr:.6f}, report {figures['psnr_db']:.6f}")
            # The truth's values have 24 bits, and a rounded code may be the next one.
            failed += abs(rmse / figures["rmse_lin"] - 1.0) > 1e-6
            failed += abs(psnr - figures["psnr_db"]) > 1e-3
        files = sorted(os.listdir(f"{folder}/truths"))
        if len(files) != len(report["paths"]) * BURST:
            print("wrong number of truths:", files)
            failed += 1
    return 1 if failed else 0


sys.exit(main())
