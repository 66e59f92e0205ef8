#!/usr/bin/env python3
"""Makes the figures of docs/choosing.md.

Usage: choosing.py errors|times|fronts|pictures DIPTYCH FOLDER [OPTION OF COST]...

errors    prints the table of FLIP at the places of the scene torture. Every machine prints the same.
times     prints how much longer a frame takes with each step, there. It needs a quiet machine.
fronts    prints the Pareto fronts of three scenes, on this machine. It needs a quiet machine.
pictures  writes FOLDER/choosing_PLACE.png: details of pictures with different settings, magnified.
          It needs ImageMagick.

The reports and pictures are written into FOLDER.
"""
import csv
import pathlib
import subprocess
import sys

PLACES = ("WIRES", "FOLIAGE", "SPECULAR", "TEXT", "WATER")
ERRORS = "--errors-only --places 1 --samples 16 --combine taa --pictures none".split()
TIMES = "--places 1 --samples 1 --combine none --pictures none --threads 1".split()
DEFAULTS = ("aa=none taa=off aaa=off asd=1 af=none aaf=off opt=off miplod=high-quality scale=1 "
            "upscale=bilinear post=off sharpen=off shadows=off gi=on mipdebug=off").split()
SCENES = ("courtyard", "torture", "tunnel")
# For each place, the left top corner of a detail in a picture of 640x480, and settings.
DETAILS = {
    "WIRES": ((20, 30), ("aa=none", "aa=4", "post=smaa", "aa=4,aaa=all")),
    "FOLIAGE": ((500, 250), ("aa=none", "aa=8", "aa=8,aaa=coverage", "aa=8,aaa=on")),
    "SPECULAR": ((240, 125), ("aa=none", "aa=4", "post=smaa", "aa=4,aaa=all")),
    "TEXT": ((140, 205), ("aa=none", "post=fxaa", "post=smaa", "miplod=sharper")),
}
DETAIL_SIZE = "96x72"
MAGNIFIED = "300%"
DETAIL_FRAME = 120
BEST = "aa=8,aaa=all,af=16,aaf=on,scale=2"


def changed(settings):
    """The settings that are not the default, or `defaults`."""
    return ",".join(s for s in settings.split(",") if s not in DEFAULTS) or "defaults"


def short(number, digits):
    """The number without a zero before its point."""
    return f"{number:.{digits}f}".replace("0.", ".", 1) if number < 1 else f"{number:.{digits}f}"


def step_table(diptych, folder, options, column, digits):
    """Prints a column of the steps' rows of a report for each place."""
    table = {}
    for place in PLACES:
        report = pathlib.Path(folder, place)
        subprocess.run([diptych, "cost", "--scene", "torture", "--path", place, "--out", report,
                        *options], check=True, stdout=subprocess.DEVNULL)
        with open(report / "cost.csv", newline="") as file:
            for row in csv.DictReader(file):
                if row["kind"] in ("step", "combination") and row[column]:
                    table.setdefault(changed(row["settings"]), {})[place] = float(row[column])
    print("| settings |" + "".join(f" `{place}` |" for place in PLACES))
    print("|---|" + "---|" * len(PLACES))
    for settings, values in table.items():
        if settings != "gi=off":
            name = settings if settings == "defaults" else f"`{settings}`"
            print(f"| {name} |" + "".join(
                f" {short(values[p], digits)} |" if p in values else " |" for p in PLACES))


def errors(diptych, folder, *options):
    step_table(diptych, folder, [*ERRORS, *options], "all_flip", 4)


def times(diptych, folder, *options):
    step_table(diptych, folder, [*TIMES, *options], "ratio", 2)


def fronts(diptych, folder, *options):
    for scene in SCENES:
        report = pathlib.Path(folder, scene)
        done = subprocess.run([diptych, "cost", "--scene", scene, "--predict", "--out", report,
                               "--pictures", "none", *options], check=True, text=True,
                              stdout=subprocess.PIPE)
        lines = done.stdout.splitlines()
        first = next(i for i, line in enumerate(lines) if line.startswith("The Pareto front"))
        until = next((i for i in range(first, len(lines)) if not lines[i]), len(lines))
        print(f"{scene}\n" + "\n".join(lines[first:until]) + "\n")


def pictures(diptych, folder):
    folder = pathlib.Path(folder)
    for place, ((x, y), sets) in DETAILS.items():
        cells = []
        for settings in (*sets, BEST):
            drawn = folder / place / settings
            subprocess.run([diptych, "dump", "--scene", "torture", "--path", place, "--size",
                            "640x480", "--frames", f"{DETAIL_FRAME}:{DETAIL_FRAME + 1}",
                            "--requested", settings, "--out", drawn], check=True)
            detail = drawn / "detail.png"
            subprocess.run(["convert", drawn / f"requested_{DETAIL_FRAME:04}.png", "-crop",
                            f"{DETAIL_SIZE}+{x}+{y}", "+repage", "-scale", MAGNIFIED, detail],
                           check=True)
            cells += ["-label", "nearly converged" if settings == BEST else settings, detail]
        subprocess.run(["montage", "-font", "DejaVu-Sans", "-pointsize", "16", *cells, "-tile",
                        f"{len(sets) + 1}x1", "-geometry", "+3+3",
                        folder / f"choosing_{place.lower()}.png"], check=True)


if __name__ == "__main__":
    {f.__name__: f for f in (errors, times, fronts, pictures)}[sys.argv[1]](*sys.argv[2:])
