#!/usr/bin/env python3
"""Measures whether reports of `diptych cost` can be believed. It needs a quiet machine and hours.

    study.py repeat [--count 5] [--load 2] DIPTYCH OUT   sweeps into OUT/quiet-1.. or OUT/loaded-1..
    study.py coverage OUT/quiet-*                      do intervals of ratios hold between runs?
    study.py verdicts OUT/*                            verdict, sign by sign, of each run
    study.py order OUT/*                               do green runs rank the steps alike?
    study.py advice OUT/*                              is the advice of green runs the best of all?
    study.py bench DIPTYCH OUT/quiet-1                 is the advice within its budget, measured anew?
    study.py unseen DIPTYCH OUT [--count 300]          are combinations that were never timed predicted
                                                       within 10 %, 90 % of them? Exits with 1 if not
    study.py p95 DIPTYCH OUT/quiet-*                   is p95 / mean that of many more rounds by bench?

The truth of a ratio is the median over the other quiet runs: a run is never part of its own truth.
Loads are loops that keep one core busy each. Figures in docs/cost-methods.md come from these commands.
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

# The spaces of docs/choosing.py, and one with the filters of finished pictures. Half of its render
# scales are below 1, where upscale counts.
SPACES = ("aa,taa,aaa,af,miplod", "aa,aaa,af,scale", "aa,scale,upscale,post,sharpen")
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


def unseen(options):
    """Counts, over all spaces together, how many predictions lie within 10 %."""
    rows, held = 0, 0.0
    for number, space in enumerate(SPACES):
        report = pathlib.Path(options.out) / ("unseen-%d" % number)
        there = report / "there.json"
        subprocess.run([options.diptych, "cost", "--out", str(report), "--quick", "--combine", space,
                        "--threads", "1", "--pictures", "none", *options.arguments],
                       stdout=subprocess.DEVNULL, check=True)
        subprocess.run([options.diptych, "cost", "predict", str(report), "--time", "6", "--check",
                        str((options.count + number) // len(SPACES)), "--json", str(there),
                        *options.arguments],
                       stdout=subprocess.DEVNULL, check=True)
        misses = json.loads(there.read_text())["misses"]["checked"]
        print("%s: %d combinations, median miss %.1f %%, 90 %% within %.1f %%, %.0f %% within 10 %%" %
              (space, misses["rows"], 100 * misses["median"], 100 * misses["p90"],
               100 * misses["within_10_percent"]), flush=True)
        rows += misses["rows"]
        held += misses["rows"] * misses["within_10_percent"]
    print("%d combinations, %.1f %% within 10 %%" % (rows, 100 * held / rows))
    sys.exit(held < 0.9 * rows)


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
    """Compares advice with the best of all measured combinations, in two ways.

    First with those that surely fit by their intervals in the same run, as advice is meant. Then
    with those that fit by the ratios of all green runs together, which one run cannot know. The
    milliseconds of a run are those of its own machine level, so a combination's time in a run is
    its usual ratio to the baseline, times the run's own baseline.
    """
    reports = green(options.reports)
    if not reports:
        sys.exit("no run is green")
    kind = ["p95_ms", "ms", "worst_ms"][reports[0]["budget_of"]]
    ratios = {}
    for report in reports:
        rows = report["rows"][report["combined_first"]:]
        report["base_ms"] = next(row[kind] for row in rows if row["text"] == "defaults")
        for row in rows:
            ratios.setdefault(row["settings"], []).append(row[kind] / report["base_ms"])
    usual = {key: statistics.median(values) for key, values in ratios.items()}
    surely = together = count = 0
    for report in reports:
        rows = {row["settings"]: row for row in report["rows"][report["combined_first"]:]}
        for item in report["advice"]:
            time = {key: usual[key] * report["base_ms"] for key in rows}
            fitting = [key for key in rows if time[key] <= item["budget_ms"]]
            if item["row"] < 0 or not fitting:
                print("%s %6g ms: none; %d fit" % (report["folder"], item["budget_ms"],
                                                   len(fitting)))
                continue
            best = rows[min(fitting, key=lambda key: flip(rows[key]))]
            row = report["rows"][item["row"]]
            least = min(flip(other) for other in rows.values()
                        if other[kind + "_high"] <= item["budget_ms"])
            count += 1
            surely += flip(row) <= 1.01 * least
            together += flip(row) <= 1.01 * flip(best)
            print("%s %6g ms: %s, %.2f ms, FLIP %.5f; best %s, %.2f ms, %.5f (%+.1f %%)" % (
                report["folder"], item["budget_ms"], row["text"], time[row["settings"]], flip(row),
                best["text"], time[best["settings"]], flip(best),
                100 * (flip(row) / flip(best) - 1)))
    print("of %d pieces of advice, %d are within 1 %% of the FLIP of the best that surely fits in "
          "their run, %d of the best that fits by all runs together" % (count, surely, together))


def set_of(row):
    return "aa=none" if row["text"] == "defaults" else row["text"]


def fastest_better(report, item):
    """Returns the fastest combination with a FLIP of over 1 % less than the advised one's, or None."""
    kind = ["p95_ms", "ms", "worst_ms"][report["budget_of"]]
    limit = 0.99 * flip(report["rows"][item["row"]])
    better = [row for row in report["rows"][report["combined_first"]:] if flip(row) < limit]
    return min(better, key=lambda row: row[kind], default=None)


def frames_by_bench(diptych, sets, rounds, arguments):
    """Times settings by `bench`. Returns the medians of the frames of each, sorted."""
    with tempfile.TemporaryDirectory() as folder:
        table = os.path.join(folder, "bench.csv")
        subprocess.run([diptych, "bench", "--sets", ";".join(sets), "--frames", "64", "--rounds",
                        str(rounds), "--csv", table, *arguments], stdout=subprocess.DEVNULL, check=True)
        times = {}
        for line in csv.DictReader(open(table)):
            times.setdefault(line["settings"], {}).setdefault(line["frame"], []).append(
                float(line["total_ms"]))
    return [sorted(statistics.median(values) for values in frames.values()) for frames in times.values()]


def percentile_95(values):
    place = 0.95 * (len(values) - 1)
    below = int(place)
    above = min(below + 1, len(values) - 1)
    return values[below] + (place - below) * (values[above] - values[below])


def p95_by_bench(diptych, sets, arguments):
    return [percentile_95(frames) for frames in frames_by_bench(diptych, sets, 8, arguments)]


def p95(options):
    """Compares p95 / mean of eight combinations with that of the frames' medians of many rounds."""
    reports = [read(folder) for folder in options.reports]
    rows = reports[0]["rows"][reports[0]["combined_first"]:]
    chosen = [rows[index * (len(rows) - 1) // 7]["settings"] for index in range(8)]
    texts = {row["settings"]: set_of(row) for row in rows}
    frames = frames_by_bench(options.diptych, [texts[key] for key in chosen], options.rounds,
                             options.arguments)
    truths = {key: percentile_95(values) / statistics.mean(values) for key, values in zip(chosen, frames)}
    misses = []
    for report in reports:
        own = {row["settings"]: row["p95_ms"] / row["ms"]
               for row in report["rows"][report["combined_first"]:] if row["settings"] in truths}
        misses.append([math.log(own[key] / truths[key]) for key in own])
    every = [miss for run in misses for miss in run]
    print("p95 / mean by bench: %s" % ", ".join("%s %.3f" % (texts[key], truths[key]) for key in chosen))
    print("%d values of %d runs: bias %+.1f %%, rms %.1f %%" % (
        len(every), len(reports), 100 * statistics.mean(every),
        100 * math.sqrt(statistics.mean(miss ** 2 for miss in every))))


def bench(options):
    report = read(options.report)
    held = beaten = 0
    for item in report["advice"]:
        if item["row"] < 0:
            print("%6g ms: none" % item["budget_ms"])
            continue
        row = report["rows"][item["row"]]
        rival = fastest_better(report, item)
        sets = ["gi=off", set_of(row)] + ([set_of(rival)] if rival else [])
        times = p95_by_bench(options.diptych, sets, options.arguments)
        held += times[1] <= item["budget_ms"]
        # The machine's level in the report: the advised row takes item["ms"] there.
        level = item["ms"] / times[1]
        fits = bool(rival) and level * times[2] <= item["budget_ms"]
        beaten += fits
        print("%6g ms: %s: %.2f ms by bench, %.2f ms (up to %.2f) in the report%s" % (
            item["budget_ms"], row["text"], times[1], item["ms"], item["ms_high"],
            "" if times[1] <= item["budget_ms"] else "  OVER"))
        if rival:
            print("           the fastest one with less FLIP, %s: %.2f ms by bench, %.2f ms at the "
                  "report's level%s" % (rival["text"], times[2], level * times[2],
                                        "  FITS" if fits else ""), flush=True)
    print("%d of %d budgets hold, %d have a better combination within them" % (
        held, len(report["advice"]), beaten))


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
    one = commands.add_parser("unseen")
    one.add_argument("diptych")
    one.add_argument("out")
    one.add_argument("--count", type=int, default=300)
    one.add_argument("arguments", nargs="*",
                     help="further options of diptych cost and cost predict, after --")
    one.set_defaults(run=unseen)
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
    one = commands.add_parser("p95")
    one.add_argument("diptych")
    one.add_argument("reports", nargs="+")
    one.add_argument("--rounds", type=int, default=24)
    one.add_argument("--arguments", type=str.split, default=[], help="further options of diptych bench")
    one.set_defaults(run=p95)
    options = parser.parse_args()
    options.run(options)


if __name__ == "__main__":
    main()
