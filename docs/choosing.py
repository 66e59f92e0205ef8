#!/usr/bin/env python3
"""Measures the table of docs/choosing.md: the FLIP of each step at the places of the scene torture.

Usage: choosing.py DIPTYCH FOLDER [OPTION OF COST]...

The reports are written into FOLDER. Errors are exact, so every machine prints the same table.
"""
import csv
import pathlib
import subprocess
import sys

PLACES = ("WIRES", "FOLIAGE", "SPECULAR", "TEXT", "WATER")
OPTIONS = "--errors-only --places 1 --samples 16 --combine taa --pictures none".split()
DEFAULTS = ("aa=none taa=off aaa=off asd=1 af=none aaf=off opt=off miplod=high-quality scale=1 "
            "upscale=bilinear post=off sharpen=off shadows=off gi=on mipdebug=off").split()


def changed(settings):
    """The settings that are not the default, or `defaults`."""
    return ",".join(s for s in settings.split(",") if s not in DEFAULTS) or "defaults"


def main(diptych, folder, *options):
    table = {}
    for place in PLACES:
        report = pathlib.Path(folder, place)
        subprocess.run([diptych, "cost", "--scene", "torture", "--path", place, "--out", report,
                        *OPTIONS, *options], check=True, stdout=subprocess.DEVNULL)
        with open(report / "cost.csv", newline="") as file:
            for row in csv.DictReader(file):
                if row["kind"] in ("step", "combination") and row["all_flip"]:
                    table.setdefault(changed(row["settings"]), {})[place] = float(row["all_flip"])
    print("| settings |" + "".join(f" {place} |" for place in PLACES))
    print("|---|" + "---|" * len(PLACES))
    for settings, flip in table.items():
        if settings != "gi=off":
            print(f"| `{settings}` |" + "".join(
                f" {flip[p]:.4f} |".replace("0.", ".") if p in flip else " |" for p in PLACES))


if __name__ == "__main__":
    main(*sys.argv[1:])
