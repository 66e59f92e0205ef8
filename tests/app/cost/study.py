#!/usr/bin/env python3
"""Measures whether reports of `diptych cost` can be believed. It needs a quiet machine and hours.

    study.py repeat DIPTYCH OUT --count 5 [--load 2]   sweeps into OUT/quiet-1.. or OUT/loaded-1..
    study.py coverage OUT/quiet-*                      do intervals of ratios hold between runs?
    study.py verdicts OUT/*                            verdict, sign by sign, of each run
    study.py order OUT/*                               do green runs rank the steps alike?
    study.py advice OUT/*                              is the advice of green runs the best of all?
    study.py bench DIPTYCH OUT/quiet-1                 is the advice within its budget, measured anew?

The truth of a ratio is the median over the other quiet runs: a run is never part of its own truth.
Loads are loops that keep one core busy each. Figures in docs/cost.md come from these commands.
"""
import argparse
import csv
import json
import math
import os
import pathlib
import statistics
import subprocess
import sys
import tempfile

BUDGETS = "4,8,16,33,5.3,6.7,9.1,11.9,14.2"


def read(folder):
    """Reads a report and lists the ratio of every timed row to its path's baseline."""
    report = json.loads((pathlib.Path(folder) / "cost.json").read_text())
    report["folder"] = str(folder)
    base_ms = [report["rows"][path["base_row"]]["ms"] for path in report["paths"]]
    for index, row in enumerate(report["rows"]):
        base = base_ms[row["path"]]
        row["ratio"] = row["ms"] / base
        row["key"] = (row["path"], row["settings"], index in
                      [path["same_row"] for path in report["paths"]])
    return report


def flip(row):
    return row["figures"]["all"]["flip"] if "all" in row["figures"] else \
        next(iter(row["figures"].values()))["flip"]


def ratios_of(report):
    """Returns {key: (ratio, low, high)} of the steps of all sweeps."""
    found = {}
    for number, sweep in enumerate(report["sweeps"]):
        for step in sweep["steps"]:
            if step["row"] != sweep["base"]:
                found[(number, step["row"])] = (step["ratio"], step["ratio_low"],
                                                step["ratio_high"])
    return found


def repeat(options):
    name = "loaded" if options.load else "quiet"
    loads = [subprocess.Popen([sys.executable, "-c", "while True: pass"])
             for _ in range(options.load)]
    try:
        for run in range(1, options.count + 1):
            out = pathlib.Path(options.out) / ("%s-%d" % (name, run))
            command = [options.diptych, "cost", "--out", str(out), "--budget-ms", BUDGETS,
                       *options.arguments]
            print(" ".join(command), flush=True)
            subprocess.run(command, stdout=subprocess.DEVNULL, check=True)
    finally:
        for load in loads:
            load.kill()


def coverage(options):
    runs = [ratios_of(read(folder)) for folder in options.reports]
    held, total, halves = 0, 0, []
    for index, run in enumerate(runs):
        for key, (_, low, high) in run.items():
            truth = statistics.median(other[key][0] for at, other in enumerate(runs)
                                      if at != index)
            held += low <= truth <= high
            total += 1
            halves.append(math.log(high / low) / 2)
    print("%d of %d intervals (%.1f %%) hold the median of the other runs; median half width "
          "%.1f %%" % (held, total, 100 * held / total, 100 * statistics.median(halves)))
    levels = [read(folder)["rows"][0]["ms"] for folder in options.reports]
    print("milliseconds of the baseline: %s" % ", ".join("%.2f" % level for level in levels))


def verdicts(options):
    for folder in options.reports:
        machine = read(folder)["machine"]
        print("%-28s %-6s wait %4.1f %%  %s" % (folder, machine["verdict"],
                                                100 * machine["wait"], machine["reason"]))


def green(folders):
    return [report for report in map(read, folders) if report["machine"]["verdict"] == "green"]


def order(options):
    """Counts steps of one sweep that two green runs rank otherwise though intervals are apart."""
    reports = green(options.reports)
    pairs = wrong = 0
    for a in reports:
        for b in reports:
            x, y = ratios_of(a), ratios_of(b)
            for s, r in x:
                for t, q in x:
                    if s == t and r < q and x[s, r][2] < x[t, q][1]:
                        pairs += 1
                        wrong += y[s, r][1] > y[t, q][2]
    print("%d green runs: %d pairs of steps are apart, %d of them are ranked otherwise in another "
          "run" % (len(reports), pairs, wrong))


def advice(options):
    """Compares advice with the best combination by the times of all green runs together."""
    reports = green(options.reports)
    if not reports:
        sys.exit("no run is green")
    settings = {}
    for report in reports:
        for row in report["rows"][report["combined_first"]:]:
            settings.setdefault(row["settings"], []).append(row)
    kind = ["p95_ms", "ms", "worst_ms"][reports[0]["budget_of"]]
    time = {key: statistics.median(row[kind] for row in rows) for key, rows in settings.items()}
    error = {key: flip(rows[0]) for key, rows in settings.items()}
    for report in reports:
        for item in report["advice"]:
            fitting = [key for key in time if time[key] <= item["budget_ms"]]
            best = min((error[key] for key in fitting), default=None)
            if item["row"] < 0:
                print("%s %6g ms: none; %d fit" % (report["folder"], item["budget_ms"],
                                                   len(fitting)))
                continue
            key = report["rows"][item["row"]]["settings"]
            print("%s %6g ms: time of all runs %.2f ms, FLIP %.5f, best %.5f (%+.1f %%)" % (
                report["folder"], item["budget_ms"], time[key], error[key], best or 0,
                100 * (error[key] / best - 1) if best else 0))


def p95_by_bench(diptych, sets, arguments):
    """Times settings by `bench`. Returns the 95th percentile of the frames' medians of each."""
    with tempfile.TemporaryDirectory() as folder:
        table = os.path.join(folder, "bench.csv")
        subprocess.run([diptych, "bench", "--sets", ";".join(sets), "--frames", "64", "--rounds",
                        "8", "--csv", table, *arguments], stdout=subprocess.DEVNULL, check=True)
        times = {}
        for line in csv.DictReader(open(table)):
            times.setdefault(line["settings"], {}).setdefault(line["frame"], []).append(
                float(line["total_ms"]))
    result = []
    for frames in times.values():
        medians = sorted(statistics.median(values) for values in frames.values())
        place = 0.95 * (len(medians) - 1)
        below = int(place)
        above = min(below + 1, len(medians) - 1)
        result.append(medians[below] + (place - below) * (medians[above] - medians[below]))
    return result


def bench(options):
    report = read(options.report)
    held = 0
    for item in report["advice"]:
        if item["row"] < 0:
            print("%6g ms: none" % item["budget_ms"])
            continue
        row = report["rows"][item["row"]]
        p95 = p95_by_bench(options.diptych, ["aa=none", row["settings"]], options.arguments)[-1]
        held += p95 <= item["budget_ms"]
        print("%6g ms: %s: %.2f ms by bench, %.2f ms (up to %.2f) in the report%s" % (
            item["budget_ms"], row["text"], p95, item["ms"], item["ms_high"],
            "" if p95 <= item["budget_ms"] else "  OVER"), flush=True)
    print("%d of %d budgets hold" % (held, len(report["advice"])))


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    commands = parser.add_subparsers(dest="command", required=True)
    one = commands.add_parser("repeat")
    one.add_argument("diptych")
    one.add_argument("out")
    one.add_argument("--count", type=int, default=5)
    one.add_argument("--load", type=int, default=0)
    one.add_argument("arguments", nargs="*", help="further options of diptych cost, after --")
    one.set_defaults(run=repeat)
    for name, run in (("coverage", coverage), ("verdicts", verdicts), ("order", order),
                      ("advice", advice)):
        one = commands.add_parser(name)
        one.add_argument("reports", nargs="+")
        one.set_defaults(run=run)
    one = commands.add_parser("bench")
    one.add_argument("diptych")
    one.add_argument("report")
    one.add_argument("arguments", nargs="*", help="further options of diptych bench, after --")
    one.set_defaults(run=bench)
    options = parser.parse_args()
    options.run(options)


if __name__ == "__main__":
    main()
