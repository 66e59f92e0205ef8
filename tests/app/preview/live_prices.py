#!/usr/bin/env python3
"""Compares rough prices with a cost report of the same scene. It needs a quiet machine.

    live_prices.py DIPTYCH PRINT MEASURE FOLDER [--poses N] [--rounds N] [--report COST.JSON]

Measures a report of the courtyard, or takes one that was measured with its ini and two threads.
Then rests at N poses along each path on which the report has measured one of the steps, and
measures there as the preview does (MEASURE, measure_prices.c). Prints, for each step, the report's
price (PRINT, print_prices.c) with its interval and the mean of the rough prices over the poses of
the same path; which share of the steps lies within the report's interval; and how well prices that are added up predict the sums that were measured: with
all prices of the report, and without those of combinations of adaptive AA or advanced AF.
Asserts only that every price is known, since times depend on the machine.
"""
import argparse
import json
import math
import pathlib
import statistics
import subprocess
import sys
import tempfile

THREADS = 2
# Prices of the settings panel, with the path's own rows: a step, and the pane that it is asked for.
PANES = ["aa=4,aaa=on,asd=2,af=16,aaf=on", "aa=8,aaa=on,asd=4,af=4,aaf=on"]
STEPS = [("aa", 5), ("aaa", 2), ("asd", 2), ("af", 5), ("aaf", 2)]
# Of the other settings, at the baseline, where the report has measured their steps.
OTHER_PANES = ["aa=none"]
OTHER_STEPS = [("taa", 3), ("miplod", 6), ("scale", 8), ("upscale", 3), ("post", 3), ("sharpen", 4)]
SUMS = ["aa=2,af=4", "aa=4,af=16", "aa=4,aaa=on,asd=2,af=16", "aa=8,af=8", "aa=8,aaa=on,af=16,aaf=on",
        "aa=6,aaa=on,asd=3,af=2"]


def questions():
    asked = []
    for panes, steps in ((PANES, STEPS), (OTHER_PANES, OTHER_STEPS)):
        for pane in panes:
            for key, count in steps:
                asked += [f"step {key} {index} {pane}" for index in range(count)]
    return asked + [f"sum {settings}" for settings in SUMS]


def measure_report(options, out):
    subprocess.run([options.diptych, "cost", "--config", options.folder / "config/courtyard.ini",
                    "--size", "320x240", "--threads", str(THREADS), "--places", "2", "--samples",
                    "4", "--pictures", "none", "--starts", "1", "--rounds", str(options.rounds), "--timed", "8",
                    "--combine", "aa,aaa,asd,af,aaf", "--cache", out / "truths", "--out", out],
                   check=True, stdout=subprocess.DEVNULL)
    return out / "cost.json"


def run(command, lines):
    answers = subprocess.run([str(part) for part in command], input="\n".join(lines) + "\n",
                             check=True, capture_output=True, text=True).stdout.splitlines()
    return [json.loads(answer) for answer in answers]


def level_of(report, path, answers):
    """The factor from this run's milliseconds to the report's: whole runs differ, ratios do not."""
    base = report["rows"][path["base_row"]]["ms"]
    now = [answer["base"] for answer in answers if "base" in answer]
    print(f"path {path['name']}: the base takes {base:.3f} ms in the report and "
          f"{statistics.mean(now):.3f} ms now; its rough prices below are in the report's "
          "milliseconds")
    return base / statistics.mean(now)


def rough_prices(options, header, path, lines):
    """The mean of each line's rough prices over the poses of a path, with its standard error."""
    count, poses = len(lines), options.poses
    answers = run([options.measure, options.folder / "config/courtyard.ini", header["width"],
                   header["height"], header["threads"], poses, path["name"]], lines)
    unknown = [line for line, answer in zip(lines * poses, answers)
               if answer["state"] == "unknown"]
    assert not unknown and len(answers) == count * poses, (path["name"], unknown)
    level = level_of(header, path, answers)
    for index in range(count):
        ms = [level * answers[pose * count + index]["ms"] for pose in range(poses)]
        yield statistics.mean(ms), statistics.stdev(ms) / math.sqrt(poses)


def rough_prices_of_all(options, header, lines, known):
    """Of each line, on the path on which the report has measured it; sums belong to the first."""
    rough = {}
    for number, path in enumerate(header["paths"]):
        first = number == 0
        here = [line for line, price in zip(lines, known)
                if price.get("path", path["name"] if first else "") == path["name"]]
        if here and not first:
            here = here + ["sum aa=none"]  # Its answer has the path's base.
        rough.update(zip(here, rough_prices(options, header, path, here)) if here else {})
    return [rough.get(line) for line in lines]


def compare_steps(lines, known, rough):
    within = near = count = 0
    for line, price, mean in zip(lines, known, rough):
        if not line.startswith("step") or price["state"] != "measured":
            continue
        count += 1
        ms, error = mean
        inside = price["low"] <= ms <= price["high"]
        overlaps = price["low"] <= ms + 2 * error and ms - 2 * error <= price["high"]
        within += inside
        near += overlaps
        print(f'{line:48} {price["path"]:8} report {price["ms"]:+7.3f} ({price["low"]:+7.3f} to '
              f'{price["high"]:+7.3f})  rough {ms:+7.3f} +- {2 * error:.3f}'
              f'{"" if inside else "  near" if overlaps else "  OUTSIDE"}')
    print(f"{within} of {count} rough prices lie within the report's intervals, {near} with their "
          "own error")


def compare_sums(lines, known, rough):
    for line, price, mean in zip(lines, known, rough):
        if line.startswith("sum"):
            ms, error = mean
            added = price["ms"] - price["together"]
            print(f'{line:48} measured {price["ms"]:7.3f} ms, prices added {added:7.3f} '
                  f'({100 * (added / price["ms"] - 1):+.1f} %), rough {ms:7.3f} +- {2 * error:.3f}')


def print_misses(what, rows, sums):
    misses = sorted((abs(ms / row["ms"] - 1), row["settings"]) for row, ms in zip(rows, sums))
    within = sum(miss <= 0.10 for miss, _ in misses)
    print(f"{what} are within 10 % of {within} of {len(misses)} measured sums; median "
          f"{100 * misses[len(misses) // 2][0]:.1f} %, worst {100 * misses[-1][0]:.1f} %: "
          f"{misses[-1][1]}")


def write_smaller_report(report, out):
    """Writes the report without adaptive AA beside AF, and without advanced AF beside AA."""
    def is_kept(index):
        steps = dict(part.split("=") for part in report["rows"][index]["settings"].split(","))
        return ((steps["aaa"] == "off" or steps["af"] == "none") and
                (steps["aaf"] == "off" or steps["aa"] == "none"))
    swept = {step["row"] for sweep in report["sweeps"] for step in sweep["steps"]}
    kept = [i for i in range(len(report["rows"]))
            if i < report["combined_first"] or i in swept or is_kept(i)]
    index_of = {old: new for new, old in enumerate(kept)} | {-1: -1}  # -1: not measured.

    def of_kept_rows(key):
        return [dict(item, row=index_of[item["row"]]) for item in report[key]
                if item["row"] in index_of]

    def at_kept_rows(item):
        return dict(item, row=index_of.get(item["row"], -1))
    predicted = report["predicted"] and dict(report["predicted"], combinations=[
        at_kept_rows(item) for item in report["predicted"]["combinations"]])
    sweeps = [dict(sweep, steps=[at_kept_rows(step) for step in sweep["steps"]])
              for sweep in report["sweeps"]]
    (out / "smaller.json").write_text(json.dumps(dict(
        report, rows=[report["rows"][i] for i in kept], advice=[], sweeps=sweeps,
        predicted=predicted, visits=of_kept_rows("visits"),
        same_pictures=of_kept_rows("same_pictures"))))
    return out / "smaller.json"


def compare_all_sums(options, file, out):
    """Adds up the prices of every combination that the report measured on path DEFAULT."""
    report = json.loads(file.read_text())
    rows = [row for row in report["rows"] if row["path"] == 0]
    lines = [f'sum {row["settings"]}' for row in rows]
    smaller = write_smaller_report(report, out)
    for name, prices in (("the report", file), ("a smaller report", smaller)):
        answers = run([options.print, prices], lines)
        print_misses(f"{name}'s prices added up", rows, [a["ms"] - a["together"] for a in answers])
        print_misses(f"the sums that are shown for {name}", rows, [a["ms"] for a in answers])


def main():
    parser = argparse.ArgumentParser()
    for name in ("diptych", "print", "measure", "folder"):
        parser.add_argument(name, type=pathlib.Path)
    parser.add_argument("--poses", type=int, default=24)
    parser.add_argument("--rounds", type=int, default=16)
    parser.add_argument("--report", type=pathlib.Path)
    options = parser.parse_args()
    lines = questions()
    with tempfile.TemporaryDirectory() as work:
        report = options.report or measure_report(options, pathlib.Path(work))
        header = json.loads(report.read_text())
        known = run([options.print, report], lines)
        rough = rough_prices_of_all(options, header, lines, known)
        compare_steps(lines, known, rough)
        compare_sums(lines, known, rough)
        compare_all_sums(options, report, pathlib.Path(work))


main()
