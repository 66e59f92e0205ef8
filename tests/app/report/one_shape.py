#!/usr/bin/python3
"""Checks that every file has one shape for an estimate: one_shape.py DIPTYCH SOURCE
MAKE_PAGE. A made-up report stands for a quiet machine.

Runs all commands that write reports. Wherever a member or a column ends with _low or _high, x, x_low
and x_high are all there; ends are null or numbers around which x may lie, and never the same. No
object has a "value" with a "low" or "high".
"""
import csv
import json
import os
import subprocess
import sys
import tempfile

failures = 0
estimates = 0


def check(what, passed, found=""):
    """Counts and prints a failure."""
    global failures
    if not passed:
        failures += 1
        print(f"one_shape.py: {what}: {found}"[:300])


def check_estimate(where, name, members):
    """Checks one estimate, from the member or column x_low or x_high."""
    global estimates
    estimates += 1
    names = [name, name + "_low", name + "_high"]
    missing = [n for n in names if n not in members]
    check(f"{where}: {names} are not all there", not missing, missing)
    if not missing:
        value, low, high = [members[n] for n in names]
        known = low is not None or high is not None
        check(f"{where}.{name}: one end is known", (low is None) == (high is None), (low, high))
        check(f"{where}.{name}: an interval without a value", value is not None or not known)
        check(f"{where}.{name}: no interval", not known or low < high, (low, high))


def walk(where, value):
    """Checks all objects within a value of JSON."""
    if isinstance(value, list):
        for i, item in enumerate(value):
            walk(f"{where}[{i}]", item)
    if isinstance(value, dict):
        check(f"{where}: an estimate is an object", not {"low", "high"} & set(value), value.keys())
        for name, item in value.items():
            if name.endswith(("_low", "_high")):
                check_estimate(where, name.rsplit("_", 1)[0], value)
            walk(f"{where}.{name}", item)


def walk_csv(name):
    """Checks all lines of a table."""
    with open(name, encoding="utf-8", newline="") as file:
        for line in csv.DictReader(file):
            numbers = {}
            for key, cell in line.items():
                try:
                    numbers[key] = float(cell) if cell else None
                except ValueError:
                    continue
            for key in numbers:
                if key.endswith("_low"):
                    check_estimate(name, key[:-4], numbers)


def main():
    diptych, source, make_page = map(os.path.abspath, sys.argv[1:4])
    os.chdir(tempfile.mkdtemp())
    model = ["--config", f"{source}/config/courtyard.ini",
             "--model", f"{source}/tests/assets/data/square.gltf"]
    small = ["--size", "48x36", "--rounds", "2", "--samples", "4", "--cache", "truths"]
    for out, more in (("a", ["--timed", "2", "--budget-ms", "0.01,1000", "--combine", "aa"]),
                      ("b", ["--timed", "2", "--combine", "aa", "--places", "1"]),
                      ("c", ["--errors-only", "--combine", "aa"])):
        rounds = [] if out == "c" else small[2:4]
        run(diptych, "cost", *model, "--out", out, *small[:2], *rounds, *small[4:], *more)
    run(make_page, "page.html", "made.json")
    run(diptych, "cost", "diff", "made.json", "made.json", "--json", "diff.json")
    run(diptych, "cost", "advise", "made.json", "--budget-ms", "1000", "--json", "advise.json")
    run(diptych, "cost", "predict", "a", *model, "--size", "64x48", "--time", "2", "--json",
        "predict.json", "--csv", "predict.csv")
    for name in ("a/cost", "b/cost", "c/cost", "made", "diff", "advise", "predict"):
        with open(name + ".json", encoding="utf-8") as file:
            walk(name, json.load(file))
    for name in ("a/cost", "c/cost", "predict"):
        walk_csv(name + ".csv")
    check("too few estimates were seen", estimates > 300, estimates)
    print(f"{estimates} estimates, {failures} failures")
    sys.exit(failures > 0)


def run(*command):
    """Runs a command."""
    done = subprocess.run(command, capture_output=True, check=False)
    check(" ".join(command[1:4]), done.returncode in (0, 1), done.stderr.decode()[-250:])


main()
