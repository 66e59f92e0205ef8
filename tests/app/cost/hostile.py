#!/usr/bin/python3
"""Gives hostile texts to every form of a report: hostile.py MAKE_PAGE DIPTYCH [--one].

Every text of a made-up cost.json is replaced in turn by one hostile text, and `cost merge`, `cost
diff` and `cost advise` read the file. They may refuse it. Without --one, they also read a file for
each hostile text, which has it at all places that may have it. If a file is not refused,
the page has the same elements and attributes as with harmless texts, its scripts' data is JSON, no
cell of the CSV is a formula, and no control character reaches the terminal.
"""
import copy
import csv
import html.parser
import json
import os
import re
import subprocess
import sys
import tempfile

HOSTILE = [
    "</script><script>alert(1)</script>\x1b[31m\x07\u009b2J\"'><img src=x onerror=alert(1)>",
    "<b onclick=1>",
    "=HYPERLINK(\"http://x\")\x1b]0;x\x07",
    "-x\"y",
    "\t+1\\\" onclick=\"",
]
failures = 0


def check(what, passed, found=""):
    """Counts and prints a failure."""
    global failures
    if not passed:
        failures += 1
        print(f"hostile.py: {what}: {found}"[:1000])


class Skeleton(html.parser.HTMLParser):
    """Lists the elements of a page with the names of their attributes, and the data of scripts."""

    def __init__(self, text):
        super().__init__()
        self.elements, self.data, self.reads = [], "", False
        self.feed(text)
        self.close()

    def handle_starttag(self, tag, attrs):
        self.elements.append((tag, *sorted(name for name, _ in attrs)))
        self.reads = ("type", "application/json") in attrs

    def handle_endtag(self, tag):
        self.elements.append(("/" + tag,))
        self.reads = False

    def handle_data(self, data):
        self.data += data if self.reads else ""

    def handle_comment(self, data):
        self.elements.append(("comment",))


def texts_of(value, path=()):
    """Lists the places of all texts of a JSON value."""
    if isinstance(value, str):
        yield path
    elif isinstance(value, (dict, list)):
        items = value.items() if isinstance(value, dict) else enumerate(value)
        for key, item in items:
            yield from texts_of(item, (*path, key))


def replaced(value, paths, text):
    """Returns a copy of a JSON value with another text at some places."""
    value = copy.deepcopy(value)
    for path in paths:
        at = value
        for key in path[:-1]:
            at = at[key]
        at[path[-1]] = text
    return value


def is_number(cell):
    """True for what a spreadsheet reads as a number."""
    return re.fullmatch(r"[-+]?[0-9.]+(e[-+]?[0-9]+)?", cell) is not None


def check_terminal(what, text):
    found = re.search(r"[\x00-\x09\x0b-\x1f\x7f-\x9f]", text)
    check(f"{what}: a control character reaches the terminal", not found, repr(found))


def run(*command):
    """Runs a command. Returns its exit status and everything that it printed."""
    done = subprocess.run(command, capture_output=True, check=False)
    return done.returncode, (done.stdout + done.stderr).decode("utf-8")


def check_forms(diptych, report, what, elements):
    """Writes all forms of a report. Returns the page's elements, or None if it was refused."""
    with open("x.json", "w", encoding="utf-8") as file:
        json.dump(report, file)
    for command in (["diff", "good.json", "x.json"], ["advise", "--budget-ms", "5", "x.json"]):
        status, text = run(diptych, "cost", *command)
        check(f"{what}: cost {command[0]} ends", status in (0, 1, 2), status)
        check_terminal(f"{what}: cost {command[0]}", text)
    status, text = run(diptych, "cost", "merge", "--pictures", "none", "--out", "out", "x.json")
    check_terminal(f"{what}: cost merge", text)
    if status != 0:
        return None
    with open("out/cost.html", encoding="utf-8") as file:
        page = Skeleton(file.read())
    try:
        count = len(json.loads(page.data))
    except json.JSONDecodeError as error:
        count = error
    check(f"{what}: the page's data has all rows", count == len(report["rows"]), count)
    if elements is not None:
        check(f"{what}: the page has other elements", page.elements == elements,
              next((a, b) for a, b in zip([*page.elements, None], [*elements, None]) if a != b)
              if page.elements != elements else "")
    with open("out/cost.csv", encoding="utf-8", newline="") as file:
        lines = list(csv.reader(file, strict=True))
    check(f"{what}: all lines of the CSV have the same cells", len(set(map(len, lines))) == 1)
    bad = [c for line in lines for c in line if c[:1] in tuple("=+-@\t\r") and c and not is_number(c)]
    check(f"{what}: a cell is a formula", not bad, bad[:1])
    with open("out/cost.json", encoding="utf-8") as file:
        json.load(file)
    return page.elements


def refused_place(diptych):
    """Returns the names of the place for which `cost merge` refuses x.json."""
    text = run(diptych, "cost", "merge", "--pictures", "none", "--out", "out", "x.json")[1]
    found = re.search(r"x.json: \[(.*)\] is missing", text)
    return tuple(re.sub(r"\[\d+\]", "", found[1]).split(".")) if found else None


def main():
    make_page, diptych = map(os.path.abspath, sys.argv[1:3])
    os.chdir(tempfile.mkdtemp())
    subprocess.run([make_page, "page.html", "good.json"], check=True)
    with open("good.json", encoding="utf-8") as file:
        good = json.load(file)
    good["rows"] = good["rows"][:12]
    good["visits"] = [visit for visit in good["visits"] if visit["row"] < 12]
    good["sweeps"] = good["sweeps"][:1]
    good["predicted"]["combinations"] = good["predicted"]["combinations"][:2]
    for item in [*good["advice"], *good["predicted"]["combinations"]]:
        item["row"] = min(item["row"], 6)
    good["same_pictures"][0]["row"] = 6
    with open("good.json", "w", encoding="utf-8") as file:
        json.dump(good, file)
    elements = check_forms(diptych, good, "harmless texts", None)
    check("the harmless report is read", elements is not None)
    seen, shown = set(), {}
    for path in texts_of(good):
        name = tuple(key for key in path if isinstance(key, str))
        if name in seen:
            continue
        seen.add(name)
        text = HOSTILE[len(seen) % len(HOSTILE)]
        what = "/".join(name) + " " + repr(text[:12])
        if check_forms(diptych, replaced(good, [path], text), what, elements) is not None:
            shown[name] = path
    check("too few hostile texts were read", len(shown) >= 4, shown)
    check("too few places have texts", len(seen) >= 12, seen)
    for text in [] if "--one" in sys.argv else HOSTILE:
        places, name = dict(shown), None
        while check_forms(diptych, replaced(good, places.values(), text), f"all {text[:12]!r}",
                          elements) is None:
            name = refused_place(diptych) # A long text, for example, does not fit everywhere.
            if places.pop(name, None) is None:
                break
        check(f"{text[:12]!r} is refused at too many places", len(places) >= 8, name)
    print(f"{len(seen)} places, {len(shown)} hostile reports shown, {failures} failures")
    sys.exit(failures > 0)


main()
