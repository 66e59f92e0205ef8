#!/usr/bin/env python3
"""Makes the figures of docs/choosing.md.

Usage: choosing.py errors|times|fronts|study|pictures|everything DIPTYCH FOLDER [OPTION OF COST]...

errors    prints the table of FLIP at the places of the scene torture. Every machine prints the same.
times     prints how much longer a frame takes with each step, there. It needs a quiet machine.
fronts    prints the Pareto fronts of three scenes, on this machine, and the sets that panels call
          Performance, Balanced and so on. It needs a quiet machine.
study     prints FLIP at six viewpoints of the courtyard beside that of an earlier study, which had
          filters of its own. Every machine prints the same.
pictures  writes FOLDER/choosing_PLACE.png: details of pictures with different settings, magnified.
          It needs ImageMagick.
everything  prints and writes all of this. With a time limit:
          timeout 60m docs/choosing.py everything build/release/diptych out

The reports and pictures are written into FOLDER. A report that is there already is read, not measured
again, and one that was interrupted is continued.
"""
import csv
import json
import pathlib
import re
import subprocess
import sys

PLACES = ("WIRES", "FOLIAGE", "SPECULAR", "TEXT", "WATER")
ERRORS = "--errors-only --places 1 --samples 16 --combine taa --pictures none".split()
TIMES = "--places 1 --samples 1 --combine none --pictures none --threads 1".split()
DEFAULTS = ("aa=none taa=off aaa=off asd=1 af=none aaf=off opt=off miplod=high-quality scale=1 "
            "upscale=bilinear post=off sharpen=off shadows=off gi=on mipdebug=off").split()
SCENES = ("courtyard", "torture", "tunnel")
# The combinations that a front is chosen from. All of these settings together are too many.
SPACES = ("aa,taa,aaa,af,miplod", "aa,aaa,af,scale")
# A set of a panel is the fastest one with this share of the gain of the best one, as in the window;
# the best one takes at most MOST_TIME times as long as the defaults.
PANEL = {"Performance": .5, "Balanced": .8, "Quality": .95, "Best": 1.}
MOST_TIME = 4.
CLEARLY_BETTER = .99  # of the FLIP of the line before
# Camera path and field of view of the study's viewpoints, and which of how many places of `cost` has
# the study's frame. (The frame of MIPLOD lies between two places.)
VIEWPOINTS = {
    "AA": ("aa", 45, 2, 9), "AAA": ("aaa", 45, 1, 9), "AF": ("af", 55, 2, 6),
    "MIPLOD": ("miplod", 50, 64, 116), "WATER": ("water", 50, 2, 9), "DEFAULT": ("ambient", 55, 0, 3),
}
# FLIP of the study: the mean of these viewpoints.
STUDY = {
    "defaults": .0595, "aa=2": .0528, "aa=4": .0509, "aa=8": .0497, "af=16": .0490, "aa=4,af=16": .0400,
    "aa=4,aaa=on": .0448, "aa=4,aaa=all": .0339, "miplod=sharp": .0536, "aa=4,miplod=sharp": .0447,
    "aa=4,miplod=sharper": .0430, "scale=1.25": .0504, "scale=1.5": .0426, "scale=2": .0332,
    "aa=4,scale=2": .0289, "aa=4,scale=1/1.3,upscale=bicubic": .0613, "aa=4,scale=1/1.5": .0790,
    "aa=4,scale=1/1.5,upscale=bicubic": .0719, "aa=4,scale=1/1.5,upscale=easu": .0725,
    "aa=4,scale=1/2,upscale=easu": .0897, "post=fxaa": .0652, "post=smaa": .0608,
    "aa=4,post=smaa": .0543, "aa=4,sharpen=low": .0508, "taa=history": .0481,
}
STUDY_RUNS = (["--combine", "taa"], ["--baseline", "aa=4", "--combine", "scale,upscale"])
STUDY_OPTIONS = "--errors-only --burst 1 --size 640x480 --pictures none".split()
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


def cost(diptych, report, *options):
    """Measures a report, unless it is there."""
    if not (report / "cost.json").exists() or (report / "cost.state").exists():
        subprocess.run([diptych, "cost", "--out", report, *options], check=True,
                       stdout=subprocess.DEVNULL)
    return report


def step_table(diptych, folder, options, column, digits):
    """Prints a column of the steps' rows of a report for each place."""
    table = {}
    for place in PLACES:
        report = cost(diptych, pathlib.Path(folder, place), "--scene", "torture", "--path", place,
                      *options)
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
    step_table(diptych, pathlib.Path(folder, "errors"), [*ERRORS, *options], "all_flip", 4)


def times(diptych, folder, *options):
    step_table(diptych, pathlib.Path(folder, "times"), [*TIMES, *options], "ratio", 2)


def candidates(report):
    """Lists time (1 is that of the defaults), FLIP and settings of a report's measured rows."""
    found = json.loads((report / "cost.json").read_text())
    base_ms = [found["rows"][path["base_row"]]["ms"] for path in found["paths"]]
    return [(row["ms"] / base_ms[row["path"]], row["figures"]["all"]["flip"], changed(row["settings"]))
            for row in found["rows"] if row["path"] == 0 and row["ms"] and "all" in row["figures"]]


def front_of(sets):
    """The sets, from the fastest on, that each have clearly less FLIP than all faster ones."""
    front = []
    for each in sorted(sets):
        if not front or each[1] < CLEARLY_BETTER * front[-1][1]:
            front.append(each)
    return front


def panel_of(front):
    """What a panel offers: names and sets. The gain is what the best set takes off the fastest one."""
    within = [each for each in front if each[0] <= MOST_TIME]
    fastest, best = within[0][1], within[-1][1]
    panel = [(name, next(each for each in within
                         if each[1] <= fastest - share * (fastest - best) + 1e-9))
             for name, share in PANEL.items()]
    blended = [each for each in within if "taa=history" in each[2]]
    if blended:
        panel.append(("Best with history", blended[-1]))
    return panel


def fronts(diptych, folder, *options):
    for scene in SCENES:
        sets = []
        for number, space in enumerate(SPACES):
            sets += candidates(cost(diptych, pathlib.Path(folder, "fronts", f"{scene}-{number}"),
                                    "--scene", scene, "--quick", "--combine", space, "--size", "640x480",
                                    "--threads", "1", "--pictures", "none", *options))
        front = front_of(sets)
        panel = panel_of(front)
        print(f"`{scene}`\n\n| settings | time | FLIP | a panel's name |\n|---|---|---|---|")
        for time, flip, settings in sorted({*front, *(each for _, each in panel)}):
            names = ", ".join(name for name, each in panel if each[2] == settings)
            print(f"| `{settings}` | {short(time, 2)} | {short(flip, 4)} | {names} |")
        print(flush=True)


def study_flip(diptych, folder, options):
    """The FLIP of each set at each viewpoint."""
    root = pathlib.Path(__file__).resolve().parent.parent
    ini = (root / "config" / "courtyard.ini").read_text().replace("../", f"{root}/")
    ini = re.sub(r"(?m)^CAMPATH_(?!DEFAULT)[A-Z]+(_FOV)?:.*\n", "", ini)
    found = {}
    for name, (path, fov, place, places) in VIEWPOINTS.items():
        config = pathlib.Path(folder, f"{name}.ini")
        config.parent.mkdir(parents=True, exist_ok=True)
        config.write_text(re.sub("(CAMPATH_DEFAULT_FOV:).*", rf"\1 {fov}", ini))
        for number, run in enumerate(STUDY_RUNS):
            report = cost(diptych, pathlib.Path(folder, f"{name}-{number}"), "--config", config,
                          "--path", root / "campaths" / f"{path}.pth", "--places", str(places),
                          "--part", f"{place}:{place + 1}",
                          *STUDY_OPTIONS, *run, *options)
            for row in json.loads((report / "cost.json").read_text())["rows"]:
                if "all" in row["figures"]:
                    found.setdefault(changed(row["settings"]), {})[name] = \
                        row["figures"]["all"]["flip"]
    return found


def study(diptych, folder, *options):
    found = study_flip(diptych, pathlib.Path(folder, "study"), options)
    print("| settings | study | product | difference |\n|---|---|---|---|")
    for settings, then in STUDY.items():
        values = found.get(settings, {}).values()
        if len(values) < len(VIEWPOINTS):
            print(f"| `{settings}` | {short(then, 4)} | not measured | |")
            continue
        now = sum(values) / len(values)
        print(f"| `{settings}` | {short(then, 4)} | {short(now, 4)} | {100 * (now / then - 1):+.1f} % |")


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


def everything(diptych, folder, *options):
    for part in (errors, study, times, fronts):
        print(f"## {part.__name__}\n", flush=True)
        part(diptych, folder, *options)
    pictures(diptych, folder)


if __name__ == "__main__":
    {f.__name__: f for f in (errors, times, fronts, study, pictures, everything)}[sys.argv[1]](*sys.argv[2:])
