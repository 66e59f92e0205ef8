#!/usr/bin/python3
"""Checks the warnings in the records of `dump` and `cost`: scene_warnings.py DIPTYCH SOURCE.

The lines on standard error are the truth: the record of `dump` has the same warnings in the same
order, and so has the report of `cost`, without the folders of files. The texts of a hostile model
arrive in all forms and act in none. Reports of earlier versions, which have no list, are read.
"""
import csv
import html
import json
import os
import re
import subprocess
import sys
import tempfile

failures = 0
LINE = re.compile(r"^diptych: (?:(?P<file>.+?)(?::(?P<line>\d+))?: )?warning: "
                  r"(?:\[(?P<key>.+?)\] )?(?P<message>.*)$")


def check(what, passed, found=""):
    """Counts and prints a failure."""
    global failures
    if not passed:
        failures += 1
        print(f"scene_warnings.py: {what}: {found}"[:1000])


def run(*command):
    """Runs a command that must succeed. Returns its output and its warnings, as a record has them."""
    done = subprocess.run(command, capture_output=True, check=False)
    errors = done.stderr.decode("utf-8")
    check(" ".join(command[1:4]), done.returncode == 0, errors)
    warnings = []
    for line in errors.splitlines():
        found = LINE.match(line)
        if found:
            warnings.append({"file": found["file"], "line": int(found["line"] or 0) or None,
                             "key": found["key"], "message": found["message"]})
    return done.stdout.decode("utf-8"), warnings


def load(name):
    """Reads a file of JSON."""
    with open(name, encoding="utf-8") as file:
        return json.load(file)


def without_folders(warnings):
    """Returns the warnings as a report has them."""
    return [{**w, "file": w["file"] and os.path.basename(w["file"])} for w in warnings]


def check_dump(diptych, name, scene, count):
    """Checks the record of a scene with this number of warnings. Returns the warnings."""
    made = []
    for threads in ("1", "3"):
        out, told = run(diptych, "dump", *scene, "--size", "32x24", "--json", "-", "--out", name,
                        "--threads", threads)
        record = json.loads(out)
        check(f"{name}: warnings of the record", record["warnings"] == told,
              (record["warnings"], told))
        check(f"{name}: number of warnings", len(told) == count, len(told))
        check(f"{name}: none is left out", record["warnings_left_out"] == 0)
        check(f"{name}: frames.json", load(f"{name}/frames.json") == record)
        made.append(record["warnings"])
    check(f"{name}: another number of threads, other warnings", made[0] == made[1])
    return made[0]


def measure(diptych, scene, out, *more):
    """Measures the errors of a scene, as fast as can be. Returns what was printed."""
    return run(diptych, "cost", *scene, "--out", out, "--size", "24x18", "--samples", "4",
               "--places", "2", "--burst", "1", "--errors-only", "--combine", "aa",
               "--pictures", "none", "--cache", "truths", *more)[0]


def check_times(diptych, scene, warnings):
    """Measures times, too, for which the program starts itself: each warning is shown once."""
    _, told = run(diptych, "cost", *scene, "--out", "timed", "--size", "24x18", "--samples", "4",
                  "--places", "1", "--burst", "1", "--quick", "--combine", "aa", "--pictures", "none",
                  "--cache", "truths")
    check("the warnings of a run with times", told == warnings, told)


def check_forms(name, text, warnings):
    """Checks all files of a report and its text against the warnings."""
    report = load(f"{name}/cost.json")
    check(f"{name}: cost.json", report["warnings"] == without_folders(warnings),
          report["warnings"])
    check(f"{name}: none is left out", report["warnings_left_out"] == 0)
    with open(f"{name}/cost.csv", encoding="utf-8", newline="") as file:
        counts = {line["warnings"] for line in csv.DictReader(file)}
    check(f"{name}: cost.csv", counts == {str(len(warnings))}, counts)
    with open(f"{name}/cost.html", encoding="utf-8") as file:
        page = file.read()
    table = re.search(r'<table id="scene-warnings".*?</table>', page, re.DOTALL)
    check(f"{name}: the page has a table", (table is not None) == bool(warnings))
    check(f"{name}: the page's contents", ('href="#warnings"' in page) == bool(warnings))
    shown = re.findall(r'<td class="l">([^<]*)</td></tr>', table[0]) if table else []
    check(f"{name}: messages of the page",
          [html.unescape(s) for s in shown] == [w["message"] for w in warnings], shown)
    told = re.search(r"Warnings +(\d+) when", text)
    check(f"{name}: the text", (int(told[1]) if told else 0) == len(warnings), told)
    return report


def check_merge(diptych, scene, warnings):
    """Joins parts of a report, of which one comes from a version without the list."""
    measure(diptych, scene, "part0", "--part", "0:1")
    measure(diptych, scene, "part1", "--part", "1:2")
    old = load("part0/cost.json")
    del old["warnings"], old["warnings_left_out"]
    with open("old.json", "w", encoding="utf-8") as file:
        json.dump(old, file)
    for parts in (["part0", "part1"], ["old.json", "part1"], ["part1", "old.json"]):
        text = run(diptych, "cost", "merge", "--out", "merged", "--pictures", "none", *parts)[0]
        check_forms("merged", text, warnings)
    text = run(diptych, "cost", "merge", "--out", "merged", "--pictures", "none", "old.json")[0]
    check_forms("merged", text, [])
    run(diptych, "cost", "diff", "old.json", "part0")


def write_hostile(source):
    """Writes a model whose texts want to be markup, and whose warnings quote them."""
    model = load(f"{source}/tests/assets/data/gltf/losses.gltf")
    for name in ("</script><script>alert(1)</script>", "a\"b'c\\", "\x1b[31m\x07\u009b2J", "=1+1"):
        model["extensionsUsed"].append(name)
    with open("hostile.gltf", "w", encoding="utf-8") as file:
        json.dump(model, file)
    for buffer in model["buffers"]:
        check("the model needs no other file", buffer["uri"].startswith("data:"))


def main():
    diptych, source = map(os.path.abspath, sys.argv[1:3])
    data = f"{source}/tests/assets/data"
    os.chdir(tempfile.mkdtemp())
    with open("twice.ini", "w", encoding="utf-8") as file:
        file.write(f"RES: 32x24\nXFILE: {data}/gltf/losses.gltf\nRES: 40x30\n")
    write_hostile(source)
    losses = check_dump(diptych, "losses", ["--model", f"{data}/gltf/losses.gltf"], 13)
    placed = check_dump(diptych, "placed", ["--config", "twice.ini"], len(losses) + 1)
    check("the ini's warning comes first, with its line",
          (placed[0]["file"], placed[0]["line"], placed[0]["key"]) == ("twice.ini", 3, "RES"), placed)
    check("the model's warnings follow", placed[1:] == losses)
    check_dump(diptych, "square", ["--model", f"{data}/square.gltf"], 0)
    hostile = check_dump(diptych, "hostile", ["--model", "hostile.gltf"], len(losses) + 4)
    check("a hostile text arrives",
          any("</script><script>alert(1)</script>" in w["message"] for w in hostile), hostile)

    for name, model, warnings in (("c-losses", f"{data}/gltf/losses.gltf", losses),
                                  ("c-square", f"{data}/square.gltf", []),
                                  ("c-hostile", "hostile.gltf", hostile)):
        check_forms(name, measure(diptych, ["--model", model], name), warnings)
    with open("c-hostile/cost.html", encoding="utf-8") as file:
        check("no script of the model's runs", "<script>alert" not in file.read())
    check_times(diptych, ["--model", f"{data}/gltf/losses.gltf"], losses)
    check_merge(diptych, ["--model", f"{data}/gltf/losses.gltf"], losses)
    print(f"{failures} failures")
    sys.exit(failures > 0)


main()
