#!/usr/bin/env python3
"""Makes the figures of docs/choosing.md.

Usage: choosing.py PART DIPTYCH FOLDER [OPTION OF COST]...

PART is one of these. Each prints the tables of the page with its name:
  errors       FLIP, RMSE and flicker at the places of the scene torture
  study        FLIP at six viewpoints of the courtyard beside that of an earlier study, which had
               filters of its own
  pictures     nothing, but writes FOLDER/choosing_PLACE.png: details of pictures with different
               settings, magnified. It needs ImageMagick
  times        how much longer a frame of torture takes with each setting
  study-times  times of a frame of the courtyard beside those of the study
  fronts       the Pareto fronts of three scenes, on this machine, and the sets that panels call
               Performance, Balanced and so on
  everything   all of this

The first three print the same on every machine. The others need a quiet machine.

Reports, times and pictures are written into FOLDER. What is there already is read, not measured
again, so the same command continues an interrupted one. Use another folder for other options.
times and study-times pass only --size, --isa and --rounds on to `diptych bench`.
"""
import argparse
import array
import bisect
import csv
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import typing

ROOT = pathlib.Path(__file__).resolve().parent.parent
PLACES = ("WIRES", "FOLIAGE", "SPECULAR", "TEXT", "WATER")
ERRORS = "--errors-only --places 1 --samples 16 --combine taa --pictures none".split()
DEFAULTS = ("aa=none taa=off aaa=off asd=1 af=none aaf=off opt=off miplod=high-quality scale=1 "
            "upscale=bilinear post=off sharpen=off shadows=off gi=on mipdebug=off").split()
# The rows of the table of FLIP, and of those of RMSE and flicker.
ERROR_SETS = ("defaults", "aa=2", "aa=4", "aa=8", "aa=4,aaa=coverage", "aa=4,aaa=on", "aa=4,aaa=all",
              "aa=8,aaa=all", "taa=history", "aa=4,taa=history", "af=2", "af=8", "af=16",
              "miplod=sharper", "scale=2", "post=fxaa", "post=smaa", "sharpen=low", "sharpen=high")
MORE_ERROR_SETS = ("defaults", "aa=4", "aa=4,aaa=all", "taa=history", "miplod=sharper", "scale=2",
                   "post=fxaa", "post=smaa")
TIME_SETS = ("aa=2", "aa=4", "aa=8", "aa=4,aaa=coverage", "aa=4,aaa=on", "aa=4,aaa=all", "af=16",
             "miplod=sharper", "scale=2", "post=fxaa", "post=smaa", "sharpen=low", "taa=history")
BENCH = "--threads 1 --size 640x480 --frames 16 --rounds 6".split()
BENCH_OPTIONS = ("--size", "--isa", "--rounds")
SCENES = ("courtyard", "torture", "tunnel")
# The combinations that a front is chosen from. All of these settings together are too many.
SPACES = ("aa,taa,aaa,af,miplod", "aa,aaa,af,scale")
# A set of a panel is the fastest one with this share of the gain of the best one, as in the window;
# the best one takes at most MOST_TIME times as long as the defaults.
PANEL = {"Performance": .5, "Balanced": .8, "Quality": .95, "Best": 1.}
MOST_TIME = 4.
CLEARLY_BETTER = .99  # of the FLIP of the line before
# Camera path and field of view of the study's viewpoints, which of how many places of `cost` has the
# study's frame (the frame of MIPLOD lies between two places), and the number of this frame at how many
# frames a second.
VIEWPOINTS = {
    "AA": ("aa", 45, 2, 9, 200, 30), "AAA": ("aaa", 45, 1, 9, 120, 30), "AF": ("af", 55, 2, 6, 300, 30),
    "MIPLOD": ("miplod", 50, 64, 116, 387, 29), "WATER": ("water", 50, 2, 9, 200, 30),
    "DEFAULT": ("ambient", 55, 0, 3, 300, 30),
}
# The study's FLIP, the mean of these viewpoints, and its times of drawing and of filtering, as
# multiples of the time of a frame without antialiasing. The time of aa=4,aaa=all is its estimate;
# the study drew four whole frames instead, which took 4.2.
STUDY = {
    "defaults": (.0595, 1, 0), "aa=2": (.0528, 1.43, 0), "aa=4": (.0509, 1.57, 0),
    "aa=8": (.0497, 1.82, 0), "af=16": (.0490, 1.46, 0), "aa=4,af=16": (.0400, 2.10, 0),
    "aa=4,aaa=on": (.0448, 1.90, 0), "aa=4,aaa=all": (.0339, 3.2, 0), "miplod=sharp": (.0536, 1.04, 0),
    "aa=4,miplod=sharp": (.0447, 1.6, 0), "aa=4,miplod=sharper": (.0430, 1.7, 0),
    "scale=1.25": (.0504, 1.32, .38), "scale=1.5": (.0426, 1.71, .46), "scale=2": (.0332, 2.79, .66),
    "aa=4,scale=2": (.0289, 3.56, .66), "aa=4,scale=1/1.3,upscale=bicubic": (.0613, .99, .60),
    "aa=4,scale=1/1.5": (.0790, .85, .21), "aa=4,scale=1/1.5,upscale=bicubic": (.0719, .85, .55),
    "aa=4,scale=1/1.5,upscale=easu": (.0725, .85, .90),
    "aa=4,scale=1/2,upscale=easu": (.0897, .62, .74), "post=fxaa": (.0652, 1, .94),
    "post=smaa": (.0608, 1, .60), "aa=4,post=smaa": (.0543, 1.57, .60),
    "aa=4,sharpen=low": (.0508, 1.57, .18), "taa=history": (.0481, 1.06, 2.07),
}
STUDY_RUNS = (["--combine", "taa"], ["--baseline", "aa=4", "--combine", "scale,upscale"])
STUDY_OPTIONS = "--errors-only --burst 4 --size 640x480 --pictures none".split()
# Beside these stands what the study made of them, from finished pictures of another size: how the
# picture was drawn, how many times as wide, and the filter that enlarged it; a larger one was averaged.
# The study's pictures at 1/1.5 had a LOD bias of -.585, where miplod=sharp has one of -.5.
AS_DRAWN = {
    "scale=2": ("aa=none", 2, None), "aa=4,scale=2": ("aa=4", 2, None),
    "aa=4,scale=1/1.5": ("aa=4,miplod=sharp", 2 / 3, "bilinear"),
    "aa=4,scale=1/1.5,upscale=bicubic": ("aa=4,miplod=sharp", 2 / 3, "bicubic"),
    "aa=4,scale=1/1.5,upscale=easu": ("aa=4,miplod=sharp", 2 / 3, "easu"),
}
FLIP_MISS, TIME_MISS = .03, .15  # what is near the study
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


class Job(typing.NamedTuple):
    """A measurement. It is done if the file `out` is there and nothing is left to continue."""
    out: pathlib.Path
    make: typing.Callable  # of the program diptych

    def done(self):
        return self.out.exists() and not (self.out.parent / "cost.state").exists()


class Part(typing.NamedTuple):
    minutes: float         # on the machine that docs/choosing.md names
    jobs: typing.Callable  # of the folder and the options: a dictionary of jobs
    show: typing.Callable  # of the files of the jobs: prints the tables


def changed(settings):
    """The settings that are not the default, or `defaults`."""
    return ",".join(s for s in settings.split(",") if s not in DEFAULTS) or "defaults"


def short(number, digits):
    """The number without a zero before its point."""
    return f"{number:.{digits}f}".replace("0.", ".", 1) if number < 1 else f"{number:.{digits}f}"


def named(settings):
    return settings if settings == "defaults" else f"`{settings}`"


def table(header, rows):
    print(f"| {' | '.join(header)} |\n|{'---|' * len(header)}")
    for row in rows:
        print("|" + "".join(f" {cell} |" if cell else " |" for cell in row))
    print(flush=True)


# --- measuring ------------------------------------------------------------------------------------


def cost_job(report, *options):
    def make(diptych):
        subprocess.run([diptych, "cost", "--out", report, *options], check=True,
                       stdout=subprocess.DEVNULL)
    return Job(report / "cost.json", make)


def bench_job(out, options, *arguments):
    passed = [word for at, word in enumerate(options)
              if word in BENCH_OPTIONS or (at and options[at - 1] in BENCH_OPTIONS)]

    def make(diptych):
        out.parent.mkdir(parents=True, exist_ok=True)
        part = out.with_suffix(".part")
        with open(part, "w") as file:
            subprocess.run([diptych, "bench", *arguments, *BENCH, *passed], check=True, stdout=file)
        part.rename(out)
    return Job(out, make)


def bench_rows(out, sets):
    """The milliseconds of the base, and the ratio and its interval for each of the other sets."""
    base_ms, rows = None, []
    for line in out.read_text().splitlines():
        found = re.match(r" *\d+  \S+ +median .* ([\d.]+) +([\d.]+) +(base|[\d.]+ to [\d.]+)$", line)
        if found and found[3] == "base":
            base_ms = float(found[1])
        elif found:
            rows.append((float(found[2]),
                         " to ".join(short(float(end), 2) for end in found[3].split(" to "))))
    if len(rows) != len(sets):
        sys.exit(f"choosing.py: {out} has times of {len(rows)} sets instead of {len(sets)}; delete it")
    return base_ms, rows


# --- errors ---------------------------------------------------------------------------------------


def error_jobs(folder, options):
    return {place: cost_job(folder / "errors" / place, "--scene", "torture", "--path", place, *ERRORS,
                            *options) for place in PLACES}


def show_errors(outs):
    found = {}
    for place, out in outs.items():
        with open(out.with_name("cost.csv"), newline="") as file:
            for row in csv.DictReader(file):
                if row["kind"] in ("step", "combination"):
                    found[changed(row["settings"]), place] = row
    for title, column, sets in (("FLIP", "all_flip", ERROR_SETS),
                                ("RMSE", "all_rmse_lin", MORE_ERROR_SETS),
                                ("flicker", "flicker_rms_lin", MORE_ERROR_SETS)):
        table([title, *(f"`{place}`" for place in PLACES)],
              [[named(settings), *(short(float(found[settings, place][column]), 4) for place in PLACES)]
               for settings in sets])


# --- the study ------------------------------------------------------------------------------------


def study_config(config, fov):
    """Writes an ini of the courtyard with this field of view and one camera path."""
    ini = (ROOT / "config" / "courtyard.ini").read_text().replace("../", f"{ROOT}/")
    ini = re.sub(r"(?m)^CAMPATH_(?!DEFAULT)[A-Z]+(_FOV)?:.*\n", "", ini)
    config.parent.mkdir(parents=True, exist_ok=True)
    config.write_text(re.sub("(CAMPATH_DEFAULT_FOV:).*", rf"\1 {fov}", ini))


def study_job(folder, name, number, options):
    path, fov, place, places, _, _ = VIEWPOINTS[name]
    config = folder / f"{name}.ini"
    job = cost_job(folder / f"{name}-{number}", "--config", config, "--path",
                   ROOT / "campaths" / f"{path}.pth", "--places", str(places), "--part",
                   f"{place}:{place + 1}", "--save-truths", folder / "truths", *STUDY_OPTIONS,
                   *STUDY_RUNS[number], *options)

    def make(diptych):
        study_config(config, fov)
        job.make(diptych)
    return Job(job.out, make)


def codes_of_light():
    """The least light of each code of 8 bits but 0: a code is the nearest one in sRGB."""
    return [light_of(code - .5) for code in range(1, 256)]


def light_of(code):
    value = code / 255
    return value / 12.92 if value <= .04045 else ((value + .055) / 1.055) ** 2.4


def codes_of(light):
    limits = codes_of_light()
    return bytes(bisect.bisect_right(limits, value) for value in light)


def write_ppm(file, width, height, codes):
    file.write_bytes(b"P6\n%d %d\n255\n" % (width, height) + codes)


def halved(codes, width, height):
    """The mean light of each 2x2 pixels of a picture of twice this size."""
    light = [light_of(code) for code in range(256)]
    row_bytes = 6 * width
    for y in range(height):
        rows = [codes[at:at + row_bytes] for at in (2 * y * row_bytes, (2 * y + 1) * row_bytes)]
        for x in range(0, row_bytes, 6):
            for at in range(x, x + 3):
                yield sum(light[row[at + right]] for row in rows for right in (0, 3)) / 4


def read_truth(file):
    """Width, height and light of a PFM file, whose bottom row is the first."""
    head, size, _, data = file.read_bytes().split(b"\n", 3)
    width, height = map(int, size.split())
    assert head == b"PF" and len(data) == 12 * width * height
    light = array.array("f", data)
    if sys.byteorder == "big":
        light.byteswap()
    return width, height, [value for y in reversed(range(height))
                           for value in light[3 * width * y:3 * width * (y + 1)]]


def as_drawn_job(folder, name):
    """FLIP of what the study made for the sets of AS_DRAWN. It drew a picture of its own of that size,
    with the angle of view that its sides give, and filtered its codes in linear light (EASU: as they
    are)."""
    path, _, place, _, frame, fps = VIEWPOINTS[name]
    out, drawn, truth = [folder / f"{name}{end}" for end in ("-drawn.json", ".rgb", "-truth.ppm")]

    def draw(diptych, settings, width, height):
        subprocess.run([diptych, "dump", "--config", folder / f"{name}.ini", "--path",
                        ROOT / "campaths" / f"{path}.pth", "--frames", f"{frame}:{frame + 1}",
                        "--fps", str(fps), "--size", f"{width}x{height}", "--requested", settings,
                        "--pane", "requested", "--raw", drawn], check=True, capture_output=True)
        return drawn.read_bytes()

    def make(diptych):
        width, height, light = read_truth(folder / "truths" / f"{path}-{place}-0.pfm")
        write_ppm(truth, width, height, codes_of(light))
        flips, pictures = {}, {}
        for number, (settings, (drawn_with, scale, enlarge)) in enumerate(AS_DRAWN.items()):
            picture, own = folder / f"{name}-{number}.ppm", (round(scale * width), round(scale * height))
            if (drawn_with, own) not in pictures:
                pictures[drawn_with, own] = draw(diptych, drawn_with, *own)
            codes = pictures[drawn_with, own]
            if enlarge:
                write_ppm(picture, *own, codes)
            else:
                write_ppm(picture, width, height, codes_of(halved(codes, width, height)))
            said = subprocess.run([diptych, "compare", picture, truth, "--json",
                                   *(["--filter", enlarge] if enlarge else [])],
                                  check=True, stdout=subprocess.PIPE)
            flips[settings] = json.loads(said.stdout)["flip"]
        out.write_text(json.dumps(flips))
    return Job(out, make)


def study_jobs(folder, options):
    jobs = {(name, number): study_job(folder / "study", name, number, options)
            for name in VIEWPOINTS for number in range(len(STUDY_RUNS))}
    return jobs | {(name, "drawn"): as_drawn_job(folder / "study", name) for name in VIEWPOINTS}


def show_as_drawn(outs):
    found = [json.loads(outs[name, "drawn"].read_text()) for name in VIEWPOINTS]
    rows = []
    for settings in AS_DRAWN:
        now, then = sum(flips[settings] for flips in found) / len(found), STUDY[settings][0]
        rows.append([named(settings), short(then, 4), short(now, 4), f"{100 * (now / then - 1):+.1f} %"])
    table(["settings", "FLIP in the study", "FLIP as it was drawn there", "difference"], rows)


def show_study(outs):
    found = {}
    for (name, number), out in outs.items():
        if number == "drawn":
            continue
        for row in json.loads(out.read_text())["rows"]:
            if "all" in row["figures"]:
                found.setdefault(changed(row["settings"]), {})[name] = row["figures"]["all"]["flip"]
    rows, near = [], 0
    for settings, (then, _, _) in STUDY.items():
        now = sum(found[settings].values()) / len(VIEWPOINTS)
        near += abs(now / then - 1) <= FLIP_MISS
        rows.append([named(settings), short(then, 4), short(now, 4), f"{100 * (now / then - 1):+.1f} %"])
    table(["settings", "FLIP in the study", "FLIP here", "difference"], rows)
    print(f"{near} of {len(STUDY)} are within {100 * FLIP_MISS:.0f} % of the study.\n")
    show_as_drawn(outs)


def study_time_jobs(folder, options):
    return {"study-times": bench_job(folder / "study-times.txt", options, "--scene", "courtyard", "--sets",
                                     ";".join(STUDY).replace("defaults", "aa=none"))}


def show_study_times(outs):
    then = list(STUDY.items())[1:]
    base_ms, measured = bench_rows(outs["study-times"], then)
    rows, near = [], 0
    for (settings, (_, draw, filtered)), (now, interval) in zip(then, measured):
        difference = now / (draw + filtered) - 1
        near += difference <= TIME_MISS
        rows.append([named(settings), short(draw, 2), short(filtered, 2) if filtered else "",
                     short(draw + filtered, 2), short(now, 2), interval, f"{100 * difference:+.0f} %"])
    table(["settings", "draw", "filter", "time in the study", "time here", "95 % interval", "difference"],
          rows)
    print(f"{near} of {len(rows)} take at most {100 * TIME_MISS:.0f} % longer than in the study. The "
          f"frame of the defaults takes {base_ms:.1f} ms.\n")


# --- times and fronts of torture and other scenes --------------------------------------------------


def time_jobs(folder, options):
    return {"times": bench_job(folder / "times.txt", options, "--scene", "torture", "--path", "TOUR",
                               "--sets", ";".join(("aa=none", *TIME_SETS)))}


def show_times(outs):
    base_ms, measured = bench_rows(outs["times"], TIME_SETS)
    table(["settings", "time", "95 % interval"],
          [[named(settings), short(ratio, 2), interval]
           for settings, (ratio, interval) in zip(TIME_SETS, measured)])
    print(f"The frame of the defaults takes {base_ms:.1f} ms.\n")


def front_jobs(folder, options):
    return {(scene, number): cost_job(
        folder / "fronts" / f"{scene}-{number}", "--scene", scene, "--quick", "--combine", space,
        "--size", "640x480", "--threads", "1", "--pictures", "none", *options)
        for scene in SCENES for number, space in enumerate(SPACES)}


def candidates(out):
    """Lists time (1 is that of the defaults), FLIP and settings of a report's measured rows."""
    found = json.loads(out.read_text())
    rows, path = found["rows"], found["paths"][0]
    base_ms = rows[path["base_row"]]["ms"]
    return [(row["ms"] / base_ms, row["figures"]["all"]["flip"], changed(row["settings"]))
            for index, row in enumerate(rows)
            if row["path"] == 0 and index != path["same_row"] and row["ms"] and "all" in row["figures"]]


def simplest(sets):
    """The sets, without those that change more settings and draw the same pictures. Their errors are
    equal to the last bit."""
    best = {}
    for each in sorted(sets, key=lambda each: (len(each[2].split(",")), each[2] != "defaults", each[0])):
        best.setdefault(each[1], each)
    return list(best.values())


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
    return [(name, next(each for each in within
                        if each[1] <= fastest - share * (fastest - best) + 1e-9))
            for name, share in PANEL.items()]


def show_fronts(outs):
    rows = []
    for scene in SCENES:
        sets = simplest([each for (of, _), out in outs.items() if of == scene
                         for each in candidates(out)])
        front = front_of(sets)
        panel = panel_of(front)
        base = next(each for each in sets if each[2] == "defaults")
        for each in sorted({base, *front}):
            names = ", ".join(name for name, chosen in panel if chosen == each)
            rows.append([f"`{scene}`", named(each[2]), short(each[0], 2), short(each[1], 4), names])
    table(["scene", "settings", "time", "FLIP", "name in a panel"], rows)


# --- pictures -------------------------------------------------------------------------------------


def picture_job(folder, place):
    out = folder / f"choosing_{place.lower()}.png"

    def make(diptych):
        (x, y), sets = DETAILS[place]
        cells = []
        for settings in (*sets, BEST):
            drawn = folder / "pictures" / place / settings
            subprocess.run([diptych, "dump", "--scene", "torture", "--path", place, "--size", "640x480",
                            "--frames", f"{DETAIL_FRAME}:{DETAIL_FRAME + 1}", "--requested", settings,
                            "--out", drawn], check=True, stdout=subprocess.DEVNULL)
            detail = drawn / "detail.png"
            subprocess.run(["convert", drawn / f"requested_{DETAIL_FRAME:04}.png", "-crop",
                            f"{DETAIL_SIZE}+{x}+{y}", "+repage", "-scale", MAGNIFIED, detail], check=True)
            cells += ["-label", "nearly converged" if settings == BEST else settings, detail]
        part = out.with_suffix(".part.png")
        subprocess.run(["montage", "-font", "DejaVu-Sans", "-pointsize", "16", *cells, "-tile",
                        f"{len(sets) + 1}x1", "-geometry", "+3+3", part], check=True)
        part.rename(out)
    return Job(out, make)


def picture_jobs(folder, _options):
    return {place: picture_job(folder, place) for place in DETAILS}


def show_pictures(outs):
    for out in outs.values():
        print(out)
    print()


# --- the command ----------------------------------------------------------------------------------

PARTS = {
    "errors": Part(5, error_jobs, show_errors),
    "study": Part(5, study_jobs, show_study),
    "pictures": Part(1, picture_jobs, show_pictures),
    "times": Part(1, time_jobs, show_times),
    "study-times": Part(2, study_time_jobs, show_study_times),
    "fronts": Part(12, front_jobs, show_fronts),
}


def say(text):
    print(f"choosing.py: {text}", file=sys.stderr, flush=True)


def make_all(names, diptych, folder, options):
    jobs = {name: PARTS[name].jobs(folder, options) for name in names}
    left = {name: PARTS[name].minutes * sum(not job.done() for job in of.values()) / len(of)
            for name, of in jobs.items()}
    done = [name for name, minutes in left.items() if not minutes]
    say(f"about {sum(left.values()):.0f} min on the machine of docs/choosing.md: " +
        ", ".join([*(f"{name} {minutes:.0f} min" for name, minutes in left.items() if minutes),
                   *(f"{name} is there" for name in done)]))
    for name in names:
        for job in jobs[name].values():
            if not job.done():
                job.make(diptych)
        if len(names) > 1:
            print(f"## {name}\n")
        PARTS[name].show({key: job.out for key, job in jobs[name].items()})


def main():
    parser = argparse.ArgumentParser(description=__doc__, usage=argparse.SUPPRESS,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("part", choices=[*PARTS, "everything"])
    parser.add_argument("diptych")
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("options", nargs=argparse.REMAINDER)
    given = parser.parse_args()
    if not os.access(given.diptych, os.X_OK) or os.path.isdir(given.diptych):
        parser.exit(2, f"choosing.py: {given.diptych} is not a program\n")
    names = list(PARTS) if given.part == "everything" else [given.part]
    if "pictures" in names and not (shutil.which("convert") and shutil.which("montage")):
        say("pictures need the programs convert and montage of ImageMagick, which are not installed")
        names.remove("pictures")
        if not names:
            sys.exit(1)
    try:
        make_all(names, os.path.abspath(given.diptych), given.folder, given.options)
    except subprocess.CalledProcessError as error:
        say(f"{error.cmd[0]} {error.cmd[1]} ended with exit code {error.returncode}; "
            "the same command continues")
        sys.exit(1)
    except KeyboardInterrupt:
        say("interrupted; the same command continues")
        sys.exit(130)


if __name__ == "__main__":
    main()
