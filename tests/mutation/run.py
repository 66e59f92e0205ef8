#!/usr/bin/env python3
"""Changes one line of Diptych at a time and checks that the tests notice.

A mutant is a copy of the source with one small change: a comparison with the other bound, a
constant plus one, a sum for a difference, a removed statement. If no test fails, the line is not
tested, or the change makes no difference. The runner works in a copy of the last commit under
build/mutation/, writes a line per mutant to a journal, and skips mutants that the journal has, so
that it can be stopped and started again. Mutants that survived are tested again after a commit.

    tests/mutation/run.py --count 60 --seed 1     random mutants
    tests/mutation/run.py --count 9 --folder app/control    random mutants of one folder
    tests/mutation/run.py --guards                the mutants of guards.txt
    tests/mutation/run.py --report                prints the journal as a table
    tests/mutation/run.py --check    fails if a guard quotes what its file does not have exactly once
"""
import argparse
import hashlib
import json
import os
import pathlib
import random
import re
import subprocess
import sys
import time

TOP = pathlib.Path(__file__).resolve().parents[2]
WORK = TOP / "build" / "mutation"
TREE = WORK / "tree"
BUILD = TREE / "build" / "ci"
FOLDERS = ("renderer", "campaths", "config", "assets", "app/measure", "app/control")
# The tests that run last, since most mutants fail a quicker one.
SLOW_TESTS = "stability_|against_reference|determinism|test_live|error_thread|cli"

# (name, pattern, replacement). A rule changes one place of a line, outside comments and texts.
RULES = [
    ("less to less-or-equal", r" < ", " <= "),
    ("less-or-equal to less", r" <= ", " < "),
    ("greater to greater-or-equal", r" > ", " >= "),
    ("greater-or-equal to greater", r" >= ", " > "),
    ("equal to unequal", r" == ", " != "),
    ("unequal to equal", r" != ", " == "),
    ("plus to minus", r" \+ ", " - "),
    ("minus to plus", r" - ", " + "),
    ("times to plus", r" \* (?=[a-z0-9(])", " + "),
    ("and to or", r" && ", " || "),
    ("or to and", r" \|\| ", " && "),
    ("min to max", r"\b(vf_min|fmin|vi_min)\(", None),
    ("max to min", r"\b(vf_max|fmax|vi_max)\(", None),
    ("constant plus one", r"(?<![\w.])(\d+)(?![\w.])", None),
    ("float constant halved", r"(?<![\w.])(\d+\.\d+)(f?)(?![\w.])", None),
    ("condition false", r"\bif \((?=.*\) \{$)", "if (0 && "),
    ("statement removed", r"^(\s+)(?!return|const|break|continue|static|[A-Z]\w+ )[\w>\-\[\]\.]+ "
                          r"[-+|&*]?= .*;$", None),
]


def replace(rule, match):
    """Returns the text that a rule puts in place of a match."""
    name, _, text = rule
    if text is not None:
        return text
    found = match.group(0)
    if name == "constant plus one":
        return str(int(match.group(1)) + 1)
    if name == "float constant halved":
        return "(0.5%s * %s)" % (match.group(2), found)
    if name == "statement removed":
        return match.group(1) + ";"
    swap = {"vf_min": "vf_max", "fmin": "fmax", "vi_min": "vi_max"}
    swap.update({value: key for key, value in swap.items()})
    return swap[match.group(1)] + "("


def code_lines(path):
    """Yields (number, line) of the lines that hold code: no comments, includes, macros, texts."""
    in_list = False
    for number, line in enumerate(path.read_text().split("\n")):
        stripped = line.strip()
        in_list = line.endswith("\\")
        if not stripped or stripped.startswith(("//", "#", "*", "}")) or in_list or '"' in line:
            continue
        yield number, line


def all_mutants(folders=FOLDERS):
    """Lists every mutant below some folders as (file, line number, rule name, start, new line)."""
    mutants = []
    for folder in folders:
        for path in sorted((TREE / folder).rglob("*.[ch]")):
            name = str(path.relative_to(TREE))
            if "/example/" in name:
                continue
            for number, line in code_lines(path):
                code = line.split("//")[0]
                for rule in RULES:
                    for match in re.finditer(rule[1], code):
                        changed = line[:match.start()] + replace(rule, match) + line[match.end():]
                        mutants.append((name, number, rule[0], match.start(), changed))
    return mutants


def read_guards():
    """Reads guards.txt: blocks of `name`, `file`, `- old line`, `+ new line`, separated by blanks.

    Returns the guards to test, and the names of those that cannot be noticed with the reason.
    """
    guards, equivalent = [], []
    text = (TOP / "tests/mutation/guards.txt").read_text()
    for block in re.split(r"\n\s*\n", text):
        lines = [line for line in block.split("\n") if line and not line.startswith("#")]
        if not lines:
            continue
        old = "\n".join(line[2:] for line in lines[2:] if line.startswith("- "))
        new = "\n".join(line[2:] for line in lines[2:] if line.startswith("+ "))
        reason = " ".join(line[2:] for line in lines[2:] if line.startswith("= "))
        if reason:
            equivalent.append((lines[0], reason))
        else:
            guards.append((lines[0], lines[1], old, new))
    return guards, equivalent


def stale_guards():
    """Lists the guards whose lines are not exactly once in their file."""
    stale = []
    for name, file, old, _ in read_guards()[0]:
        path = TOP / file
        found = path.read_text().count(old) if path.exists() else 0
        if found != 1:
            stale.append("%s: %s has these lines %d times:\n%s" % (name, file, found, old))
    return stale


def run(command, seconds, folder=TREE):
    """Runs a command. Returns (exit code or None after the time limit, last lines of output)."""
    try:
        done = subprocess.run(command, cwd=folder, timeout=seconds, stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, text=True, errors="replace")
        return done.returncode, done.stdout[-2000:]
    except subprocess.TimeoutExpired:
        return None, "the time limit of %d s" % seconds


def prepare():
    """Makes or renews the copy of the last commit, and builds it."""
    WORK.mkdir(parents=True, exist_ok=True)
    head = subprocess.check_output(["git", "rev-parse", "HEAD"], cwd=TOP, text=True).strip()
    if not TREE.exists():
        subprocess.check_call(["git", "clone", "-q", str(TOP), str(TREE)])
    subprocess.check_call(["git", "fetch", "-q", "origin"], cwd=TREE)
    subprocess.check_call(["git", "checkout", "-q", "--force", "--detach", head], cwd=TREE)
    for command in (["cmake", "--preset", "ci", "-DDIP_WERROR=OFF"], ["cmake", "--build", "--preset", "ci"]):
        code, output = run(command, 1800)
        if code != 0:
            sys.exit("the unchanged tree does not build:\n" + output)
    return head


def digest(folder):
    """Hashes the object files below a folder, to recognise mutants that compile to the same code."""
    total = hashlib.sha256()
    for path in sorted(folder.rglob("*.o")):
        total.update(path.read_bytes())
    return total.hexdigest()


def ctest(*choice):
    """Runs a choice of the unit and picture tests. Returns the first test that fails, or None."""
    code, output = run(["ctest", "--test-dir", "build/ci", "-L", "unit|image", "-LE", "long|window",
                        "-j", str(os.cpu_count()), "--stop-on-failure", "--timeout", "600",
                        *choice], 3600)
    if code == 0:
        return None
    failed = re.findall(r"Test +#\d+: (\S+) .*(?:Failed|Timeout|Exception)", output)
    return failed[0] if failed else "ctest"


def judge(unchanged):
    """Builds and tests the changed tree, quick tests first. Returns (verdict, by what)."""
    code, output = run(["cmake", "--build", "--preset", "ci", "--target", "stability"], 900)
    if code != 0:
        return "invalid", "does not compile"
    code, output = run(["build/ci/tests/stability/stability", "--depth", "short"], 400)
    if code != 0:
        rows = re.findall(r"^(\S+) +\S+ +FAILS", output, re.M)
        return "caught", "row %s" % rows[0] if rows else "stability: " + output[-80:]
    code, output = run(["cmake", "--build", "--preset", "ci"], 1800)
    if code != 0:
        return "invalid", "does not compile"
    if digest(BUILD) == unchanged:
        return "equivalent", "the same machine code"
    failed = ctest("-E", SLOW_TESTS) or ctest("-R", SLOW_TESTS) or sanitizer()
    return ("caught", failed) if failed else ("survived", "")


def sanitizer():
    """Runs the catalogue with the address and undefined-behaviour sanitizers,
    as ./test sanitizers does."""
    for command in (["cmake", "--preset", "asan", "-DDIP_WERROR=OFF"],
                    ["cmake", "--build", "--preset", "asan", "--target", "stability"]):
        code, output = run(command, 1800)
        if code != 0:
            return None
    code, output = run(["build/asan/tests/stability/stability", "--depth", "short"], 1800)
    found = re.findall(r"runtime error: .*|ERROR: AddressSanitizer.*|^\S+ +\S+ +FAILS", output, re.M)
    return None if code == 0 else "sanitizer: " + (found[0] if found else "exit %s" % code)


def journal_lines(path):
    return [json.loads(line) for line in path.read_text().splitlines()] if path.exists() else []


def test_mutants(mutants, count, journal, head, unchanged):
    """Tests mutants (identity, file, apply) in order, until `count` of them changed the code.

    `apply` returns the changed text of the file, or None where it does not hold the line.
    """
    known = {entry["id"]: entry["verdict"] for entry in journal_lines(journal)
             if entry["commit"] == head or entry["verdict"] != "survived"}
    judged = 0
    for identity, name, apply in mutants:
        if judged == count:
            break
        if identity not in known:
            known[identity] = test_mutant(identity, name, apply, journal, head, unchanged)
        judged += known[identity] in ("caught", "survived")


def test_mutant(identity, name, apply, journal, head, unchanged):
    """Tests one mutant, writes its line to the journal and returns the verdict."""
    path = TREE / name
    before = path.read_text()
    after = apply(before)
    begin = time.time()
    if after is None or after == before:
        verdict, by = "invalid", "the line is not there"
    else:
        path.write_text(after)
        try:
            verdict, by = judge(unchanged)
        finally:
            path.write_text(before)
    entry = {"id": identity, "commit": head, "verdict": verdict, "by": by,
             "seconds": round(time.time() - begin)}
    with journal.open("a") as file:
        file.write(json.dumps(entry) + "\n")
    print("%s (%d s): %s%s" % (identity, entry["seconds"], verdict, " by " + by if by else ""),
          flush=True)
    return verdict


def change_line(number, changed):
    def apply(text):
        lines = text.split("\n")
        lines[number] = changed
        return "\n".join(lines)
    return apply


def report(journal):
    entries = {entry["id"]: entry for entry in journal_lines(journal)}.values()  # the latest of each
    counts = {}
    for entry in entries:
        counts[entry["verdict"]] = counts.get(entry["verdict"], 0) + 1
        if entry["verdict"] in ("survived", "equivalent"):
            print("%-10s %s" % (entry["verdict"], entry["id"]))
    for name, reason in read_guards()[1]:
        print("equivalent guard: %s. %s" % (name, reason))
    judged = counts.get("caught", 0) + counts.get("survived", 0)
    print(", ".join("%d %s" % (count, verdict) for verdict, count in sorted(counts.items())))
    if judged:
        print("%.1f %% of %d mutants that change the code were caught"
              % (100.0 * counts.get("caught", 0) / judged, judged))


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--count", type=int, default=0, help="number of random mutants that change the code")
    parser.add_argument("--seed", type=int, default=1, help="seed of the random choice")
    parser.add_argument("--folder", action="append", choices=FOLDERS,
                        help="take random mutants from this folder only; may be given several times")
    parser.add_argument("--guards", action="store_true", help="test the mutants of guards.txt")
    parser.add_argument("--report", action="store_true", help="only print what the journal holds")
    parser.add_argument("--check", action="store_true",
                        help="only check that the files have the lines that guards.txt quotes")
    parser.add_argument("--list", action="store_true", help="only list the mutants")
    parser.add_argument("--journal", type=pathlib.Path, default=WORK / "journal.jsonl")
    options = parser.parse_args()
    if options.report:
        report(options.journal)
        return
    if options.check:
        sys.exit("\n".join(stale_guards()) or None)
    head = prepare()
    mutants = []
    if options.guards:
        for name, file, old, new in read_guards()[0]:
            mutants.append(("guard: " + name, file,
                            lambda text, old=old, new=new:
                            text.replace(old, new, 1) if old in text else None))
    count = len(mutants) + options.count
    if options.count:
        chosen = all_mutants(options.folder or FOLDERS)
        random.Random(options.seed).shuffle(chosen)
        for name, number, rule, _, changed in chosen:
            identity = "%s:%d: %s: %s" % (name, number + 1, rule, changed.strip())
            mutants.append((identity, name, change_line(number, changed)))
    if options.list:
        print("\n".join(identity for identity, _, _ in mutants[:count]))
        return
    test_mutants(mutants, count, options.journal, head, digest(BUILD))
    report(options.journal)


if __name__ == "__main__":
    main()
