#!/usr/bin/env python3
"""Draws glTF models by three.js and by Diptych with the same light, and compares the pictures.

Usage: beside.py DIPTYCH FOLDER OUT [--npm FOLDER] [--scale K] [--bars FILE] [--names NAME,NAME]

Takes every .glb and .gltf file below FOLDER. For view N of each model, OUT gets NAME.truth.N.png
(three.js), NAME.N.png (Diptych) and NAME.difference.N.png (eight times the difference), and
table.md and the contact sheets sheet_1.png, sheet_2.png, ... show all, three.js on the left.
Pictures of three.js that OUT has already are not drawn again.

NAME.pose beside a model has its views (make_models.py); without it, the whole model is drawn, half
a second into its first animation if it has one. Lights of files are left out: the fixed light is
compared. Each pixel of three.js is the mean of K x K samples; K is 4 unless --scale gives another.

npm installs three.js into --npm FOLDER, or OUT. With --bars, the exit code is 1 if the PSNR of a
view is below the bar that the file gives its model, or if the file names a model that is not there.

Needs chromium, node, npm and a network, numpy and Pillow; if one is missing, the exit code is 77.
"""
import argparse
import json
import math
import pathlib
import shutil
import subprocess
import sys

import ours

THREE = "0.187.0"
HERE = pathlib.Path(__file__).resolve().parent
try:
    import numpy as np
    from PIL import Image, ImageDraw
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(77)


def skip(why):
    print(f"skipped: {why}")
    sys.exit(77)


def install_three(folder):
    """Returns the folder of three.js, which npm installs once."""
    for program in ("chromium", "node", "npm"):
        if not shutil.which(program):
            skip(f"{program} is missing")
    folder.mkdir(parents=True, exist_ok=True)
    package = folder / "node_modules" / "three"
    about = package / "package.json"
    if not about.exists() or json.loads(about.read_text())["version"] != THREE:
        done = subprocess.run(
            ["npm", "install", "--no-fund", "--no-audit", "--prefix", ".", f"three@{THREE}"],
            cwd=folder, capture_output=True, text=True, check=False)
        if done.returncode:
            skip("npm cannot install three.js")
    print(f"three.js {THREE}", flush=True)
    return package.resolve()


def draw_truths(models, out, args):
    """Draws by three.js what OUT lacks. Sets the views of all models that three.js draws."""
    jobs = []
    for model in models:
        base = out / f"{model.name}.truth"
        views, refused = (pathlib.Path(f"{base}.{end}") for end in ("views.json", "refused.txt"))
        known = json.loads(views.read_text()) if views.exists() else [None]
        pictures = [pathlib.Path(f"{base}.{n}.png").exists() for n in range(len(known))]
        if not (all(pictures) and model.views in (None, known)) and not refused.exists():
            job = {"model": str(model.file), "out": str(base)}
            jobs.append({**job, "views": model.views} if model.views else job)
    if jobs:
        package = install_three(args.npm or out)
        (out / "jobs.json").write_text(json.dumps({
            "width": ours.SIZE[0], "height": ours.SIZE[1], "scale": args.scale,
            "background": ours.BACKGROUND, "jobs": jobs}))
        subprocess.run(["node", HERE / "truths.mjs", out / "jobs.json", package], check=True)
    for model in models:
        views = out / f"{model.name}.truth.views.json"
        model.views = json.loads(views.read_text()) if views.exists() else []


def compare(truth, picture):
    """Returns the PSNR in dB, the per cent of pixels that are off by more than 32 codes, and the
    difference."""
    difference = np.abs(truth.astype(float) - picture)
    error = (difference**2).mean()
    psnr = 10 * math.log10(255**2 / error) if error else math.inf
    return psnr, 100 * (difference.max(2) > 32).mean(), difference


def draw_ours(models, out, diptych):
    """Returns a row for each view: name, PSNR, per cent off, both pictures, messages."""
    rows = []
    for model in models:
        if not model.views:
            reason = out / f"{model.name}.truth.refused.txt"
            said = reason.read_text().splitlines()[0] if reason.exists() else "no picture"
            rows.append((model.name, None, None, None, None, f"three.js: {said}"))
        for n, view in enumerate(model.views):
            truth = np.asarray(Image.open(out / f"{model.name}.truth.{n}.png"))
            _, said, data = ours.draw(diptych, model, view)
            name = f"{model.name} {n}" if n else model.name
            if not data:
                rows.append((name, None, None, truth, None, said))
                continue
            picture = np.frombuffer(data, np.uint8).reshape(truth.shape)
            psnr, off, difference = compare(truth, picture)
            Image.fromarray(picture).save(out / f"{model.name}.{n}.png")
            Image.fromarray(np.clip(difference * 8, 0, 255).astype(np.uint8)).save(
                out / f"{model.name}.difference.{n}.png")
            rows.append((name, psnr, off, truth, picture, said))
            print(f"{name}: {psnr:.1f} dB, {off:.3f} % off", flush=True)
    return rows


def write_sheets(rows, out, columns=3, lines=4):
    w, h, top = 320, 240, 18
    for number, first in enumerate(range(0, len(rows), columns * lines), 1):
        part = rows[first:first + columns * lines]
        sheet = Image.new("RGB", (columns * (2 * w + 10), -(-len(part) // columns) * (h + top + 4)),
                          (250, 250, 250))
        for k, (name, psnr, _, truth, picture, _) in enumerate(part):
            x, y = k % columns * (2 * w + 10), k // columns * (h + top + 4)
            title = name if psnr is None else f"{name}: {psnr:.1f} dB"
            ImageDraw.Draw(sheet).text((x + 4, y + 4), title, fill=(0, 0, 0))
            for i, pixels in enumerate((truth, picture)):
                if pixels is not None:
                    small = Image.fromarray(pixels).resize((w, h), Image.LANCZOS)
                    sheet.paste(small, (x + i * (w + 2), y + top))
        sheet.save(out / f"sheet_{number}.png")


def write_table(rows, out):
    lines = ["| model | PSNR, dB | off by more than 32 codes, % | messages |", "|---|---|---|---|"]
    for name, psnr, off, _, _, said in rows:
        figures = "- | -" if psnr is None else f"{psnr:.1f} | {off:.3f}"
        lines.append(f"| {name} | {figures} | {said.replace('|', '/')} |")
    (out / "table.md").write_text("\n".join(lines) + "\n")


def judge(rows, file):
    """Prints what is below its bar. A line of the file: NAME BAR, and the reason behind a #."""
    bars = {}
    for line in file.read_text().splitlines():
        words = line.split("#")[0].split()
        if words:
            bars[words[0]] = float(words[1])
    drawn = {name.split()[0] for name, *_ in rows}
    faults = [f"{name} is not in the folder" for name in sorted(set(bars) - drawn)]
    for name, psnr, *_ in rows:
        bar = bars.get(name.split()[0])
        if bar is None:
            faults.append(f"{name} has no bar")
        elif psnr is None or psnr < bar:
            faults.append(f"{name}: {psnr and round(psnr, 2)} dB, the bar is {bar}")
    print("\n".join(faults))
    return not faults


def main():
    parser = argparse.ArgumentParser(usage=__doc__)
    parser.add_argument("diptych")
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("--npm", type=pathlib.Path)
    parser.add_argument("--scale", type=int, default=4)
    parser.add_argument("--bars", type=pathlib.Path)
    parser.add_argument("--names", default="")
    args = parser.parse_args()
    args.out.mkdir(parents=True, exist_ok=True)
    models = ours.find_models(args.folder)
    if args.names:
        models = [m for m in models if m.name in args.names.split(",")]
    draw_truths(models, args.out, args)
    rows = draw_ours(models, args.out, args.diptych)
    write_sheets(rows, args.out)
    write_table(rows, args.out)
    return 0 if not args.bars or judge(rows, args.bars) else 1


sys.exit(main())
