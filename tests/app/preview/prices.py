#!/usr/bin/env python3
"""Compares the preview's prices of a report with the report's JSON: prices.py DIPTYCH PRINT FOLDER.

Measures a small report of the square model, asks PRINT (print_prices.c) for the prices of all steps
of its sweeps and of all its combinations, and computes them again from the JSON alone. FOLDER is
the top of the sources.
"""
import json
import pathlib
import subprocess
import sys
import tempfile

failures = 0


def check(what, value, expected):
    global failures
    if not abs(value - expected) <= 1e-9 * max(1.0, abs(expected)):
        failures += 1
        print(f"FAILED: {what}: {value}, expected {expected}")


def settings_of(text):
    return dict(part.split("=") for part in text.split(","))


def text_of(settings):
    return ",".join(f"{key}={step}" for key, step in settings.items())


def measure(diptych, folder, out):
    subprocess.run([diptych, "cost", "--size", "48x32", "--places", "2", "--samples", "4",
                    "--starts", "1", "--rounds", "3", "--timed", "2", "--combine", "aa,af", "--cache", out / "truths",
                    "--model", folder / "tests/assets/data/square.gltf", "--out", out],
                   check=True, capture_output=True)
    return json.loads((out / "cost.json").read_text())


def ask(printer, out, questions):
    answers = subprocess.run([printer, out / "cost.json"], input="\n".join(questions) + "\n",
                             check=True, capture_output=True, text=True).stdout.splitlines()
    assert len(answers) == len(questions)
    return [json.loads(answer) for answer in answers]


def flip_of(row):
    return row["figures"]["all"]["flip"]


def check_step(report, sweep, step, answer):
    """A step of a sweep: the report's own ratio and change of FLIP."""
    row, base = report["rows"][step["row"]], report["rows"][sweep["base"]]
    what = f'{sweep["title"]}: {row["text"]}'
    assert answer["path"] == report["paths"][row["path"]]["name"], answer
    assert answer["needs"] == "", answer
    check(what + ", ms", answer["ms"], row["ms"] - base["ms"])
    low = answer["ms"] - (step["ratio"] - step["ratio_low"]) * base["ms"]
    high = answer["ms"] + (step["ratio_high"] - step["ratio"]) * base["ms"]
    check(what + ", low", answer["low"], low)
    check(what + ", high", answer["high"], high)
    width = high - low
    zero = (width <= 0.2 * base["ms"] if low <= 0.0 <= high else
            abs(answer["ms"]) < 0.05 and width <= max(0.2, 0.5 * abs(answer["ms"])))
    assert answer["zero"] == (zero and report["machine"]["verdict"] != "red"), answer
    assert answer["floor"] == row["at_floor"], answer
    check(what + ", FLIP", answer["flip"], flip_of(row) - flip_of(base))


def check_sweeps(report, printer, out):
    """Asks for each step in a pane that has the row's own settings, so with all its company."""
    questions, wanted = [], []
    for sweep in report["sweeps"]:
        steps = [line["row"] for line in sweep["steps"]]
        for step in sweep["steps"]:
            if step["row"] == sweep["base"]:
                continue
            row = settings_of(report["rows"][step["row"]]["settings"])
            value = row[sweep["setting"]]
            index = STEPS[sweep["setting"]].index(value)
            questions.append(f'step {sweep["setting"]} {index} {text_of(row)}')
            wanted.append((sweep, step))
        assert len(steps) >= 2
    for (sweep, step), answer in zip(wanted, ask(printer, out, questions)):
        assert answer["state"] == "measured", (sweep["title"], answer)
        check_step(report, sweep, step, answer)
    return len(questions)


def check_sums(report, printer, out):
    rows = [row for index, row in enumerate(report["rows"])
            if row["path"] == 0 and index != report["paths"][0]["same_row"]]
    answers = ask(printer, out, [f'sum {row["settings"]}' for row in rows])
    base = report["rows"][report["paths"][0]["base_row"]]
    assert [row for row in rows if row["settings"] == base["settings"]] == [base]
    known = {}
    for row, answer in zip(rows, answers):
        row = known.setdefault(row["settings"], row)  # Of equal rows, the first.
        assert answer["state"] == "measured", (row["text"], answer)
        parts = answer["base"]
        for part in answer["parts"]:
            parts += part
        assert parts + answer["together"] == answer["ms"], answer
        check(row["text"] + ", sum", answer["ms"], row["ms"])
        check(row["text"] + ", sum's low", answer["low"], row["ms_low"])
        check(row["text"] + ", sum's high", answer["high"], row["ms_high"])
        check(row["text"] + ", sum's FLIP", answer["flip"], flip_of(row))
    return len(rows)


STEPS = {
    "aa": ["none", "2", "4", "6", "8"], "taa": ["off", "alternate", "history"], "aaa": ["off", "coverage", "on", "all"],
    "asd": ["1", "2", "3", "4"], "af": ["none", "2", "4", "8", "16"], "aaf": ["off", "on"],
    "opt": ["off", "standard", "advanced"],
    "miplod": ["high-performance", "performance", "quality", "high-quality", "sharp",
               "sharper"], "scale": ["1/2", "1/1.7", "1/1.5", "1/1.3", "1", "1.25", "1.5", "2"],
    "upscale": ["bilinear", "bicubic", "easu"],
    "post": ["off", "fxaa", "smaa"], "sharpen": ["off", "low", "medium", "high"],
    "shadows": ["off", "512", "1024", "2048"], "gi": ["off", "on"],
}


def main():
    diptych, printer, folder = sys.argv[1], sys.argv[2], pathlib.Path(sys.argv[3])
    with tempfile.TemporaryDirectory() as work:
        out = pathlib.Path(work)
        report = measure(diptych, folder, out)
        steps = check_sweeps(report, printer, out)
        sums = check_sums(report, printer, out)
        # A combination that no row has: the model or the parts.
        unmeasured = ask(printer, out, ["sum aa=4,aaa=on,af=16,opt=advanced"])[0]
        assert unmeasured["state"] in ("predicted", "rough"), unmeasured
        assert unmeasured["low"] <= unmeasured["ms"] <= unmeasured["high"], unmeasured
    print(f"{steps} steps and {sums} sums agree with the report; "
          f"one that was not measured is {unmeasured['state']}")
    return 1 if failures else 0


sys.exit(main())
