#!/usr/bin/env python3
"""Changes one line of Diptych at a time and checks that the tests notice.

A mutant is a copy of the source with one small change: a comparison with the other bound, a
constant plus one, a sum for a difference, a removed statement. If no test fails, the line is not
tested, or the change makes no difference. The runner works in a copy of the last commit under
build/mutation/, writes a line per mutant to a journal, and skips mutants that the journal has, so
that it can be stopped and started again. Mutants that survived are tested again after a commit.

A mutant goes through these stages until one catches it:

1. near: the quick tests of the nearest folder that has some: for renderer/pipeline/texture/texture.c
   those of tests/renderer/pipeline. Only their programs are built.
2. catalogue: the catalogue of hard cases (tests/stability), if the mutant is in its program.
3. hashes: the shipped hashes of whole pictures, if the mutant is in the program that tests them.
4. folder: the other tests of the nearest folder. Again, only their programs are built.
5. all: everything is built, and the other unit and picture tests run, slow ones last.
6. sanitizer: the nearest quick tests and the catalogue again, with the address and
   undefined-behaviour sanitizers.

A stage runs only the tests that run a program whose bytes changed: the others cannot fail.

After the first build of a file that was changed, its object files are compared with those of the
unchanged tree. If none differs, those that were not built yet decide whether the mutant is
equivalent. A journal's line tells the stage that caught the mutant. Before the first mutant of a
commit, the tests of all these folders run in the unchanged tree, which must pass them. This tells
how long they take.

The working copy is configured with the environment's CMAKE_C_COMPILER_LAUNCHER, if it is set when
the copy is made: with a compiler cache, undoing a mutant costs little.

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
# The folders of random mutants, unless others are asked for.
FOLDERS = ("renderer", "campaths", "config", "assets", "app/measure", "app/control")
OTHER_FOLDERS = sorted({"app/" + path.parent.name for path in (TOP / "app").glob("*/CMakeLists.txt")}
                       .difference(FOLDERS))
# The tests that run last, since most mutants fail a quicker one.
SLOW_TESTS = "stability_|against_reference|determinism|test_live|error_thread|cli"
# The choice of ctest among all tests.
CHOICE = ["-L", "unit|image", "-LE", "long|window"]
# A test of the nearest folder that takes longer runs after the catalogue of hard cases.
QUICK_SECONDS = 5.0
# A test that takes longer fails, if it sets no limit of its own. The slowest one takes 15 s.
TEST_SECONDS = 200
STABILITY = "tests/stability/stability"
HASHES = "tests/renderer/scene/test_shipped_hashes"

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
    """Runs a command. Returns (exit code or None after the time limit, output)."""
    try:
        done = subprocess.run(command, cwd=folder, timeout=seconds, stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, text=True, errors="replace")
        return done.returncode, done.stdout
    except subprocess.TimeoutExpired:
        return None, "the time limit of %d s" % seconds


def prepare():
    """Makes or renews the copy of the last commit, and builds it."""
    WORK.mkdir(parents=True, exist_ok=True)
    head = subprocess.check_output(["git", "rev-parse", "HEAD"], cwd=TOP, text=True).strip()
    if not TREE.exists():
        subprocess.check_call(["git", "clone", "-q", str(TOP), str(TREE)])
    subprocess.check_call(["git", "fetch", "-q", "origin", "HEAD"], cwd=TREE)
    subprocess.check_call(["git", "checkout", "-q", "--force", "--detach", head], cwd=TREE)
    for command in (["cmake", "--preset", "ci", "-DDIP_WERROR=OFF"], ["cmake", "--build", "--preset", "ci"]):
        code, output = run(command, 1800)
        if code != 0:
            sys.exit("the unchanged tree does not build:\n" + output[-2000:])
    return head


def hashes(objects):
    """Maps object files, as paths relative to BUILD, to hashes of their bytes."""
    return {name: hashlib.sha256((BUILD / name).read_bytes()).hexdigest() for name in objects}


class Unchanged:
    """What the unchanged tree, which prepare() has built, tells about its files and tests."""

    def __init__(self, head, folders):
        # The objects that are compiled from each source or header, and what their bytes are.
        self.objects = {}
        text = subprocess.check_output(["ninja", "-t", "deps"], cwd=BUILD, text=True)
        for block in text.split("\n\n"):
            lines = block.split("\n")
            name = lines[0].split(": #deps")[0]
            if name.endswith(".o"):
                for line in lines[1:]:
                    path = os.path.normpath(BUILD / line.strip())
                    self.objects.setdefault(path, []).append(name)
        self.hashes = hashes({name for names in self.objects.values() for name in names})
        self.tests = self.list_tests()
        self.programs = hashes({program for tests in self.tests.values()
                                for program in programs_of(tests)})
        self.seconds = self.time_tests(head, {*FOLDERS, *folders})

    def list_tests(self):
        """Maps each folder of tests/ to its tests, and each test to the programs of its command.

        Only tests that run a program of the build are listed."""
        made = subprocess.check_output(["ninja", "-t", "targets", "all"], cwd=BUILD, text=True)
        made = {line.split(": ")[0] for line in made.splitlines()}
        shown = json.loads(subprocess.check_output(
            ["ctest", "--test-dir", str(BUILD), *CHOICE, "--show-only=json-v1"], text=True))
        folders = {}
        for test in shown["tests"]:
            programs = [os.path.relpath(word, BUILD) for word in test.get("command", [])
                        if word.startswith(str(BUILD) + "/")]
            programs = [name for name in programs if name in made]
            folder = [entry["value"] for entry in test["properties"]
                      if entry["name"] == "WORKING_DIRECTORY"][0]
            if programs:
                folders.setdefault(os.path.relpath(folder, BUILD), {})[test["name"]] = programs
        return folders

    def time_tests(self, head, folders):
        """Measures how long the tests that may be the nearest of a file in some folders take, once per
        commit. All must succeed. Returns their seconds by name."""
        kept = WORK / "seconds.json"
        if kept.exists():
            entry = json.loads(kept.read_text())
            if entry["commit"] == head and folders <= set(entry.get("folders", FOLDERS)):
                return entry["seconds"]
        names = [name for folder, tests in self.tests.items() for name in tests
                 if folder.startswith(tuple("tests/" + start for start in folders))]
        code, output = run_ctest("-R", one_of(names), "-E", SLOW_TESTS)
        if code != 0:
            sys.exit("a test of the unchanged tree fails:\n" + output[-2000:])
        found = re.findall(r"Test +#\d+: (\S+) .*Passed +([\d.]+) sec", output)
        seconds = {name: float(text) for name, text in found}
        kept.write_text(json.dumps({"commit": head, "folders": sorted(folders), "seconds": seconds}))
        return seconds

    def near_tests(self, file):
        """Maps the tests that are nearest to a file to the programs that they run.

        Returns the quick ones and the others."""
        for folder in pathlib.PurePath(file).parents:
            tests = self.tests.get(str("tests" / folder), {})
            tests = {name: programs for name, programs in tests.items() if name in self.seconds}
            if tests:
                quick = [name for name in tests if self.seconds[name] < QUICK_SECONDS]
                return ({name: tests[name] for name in tests if name in quick},
                        {name: tests[name] for name in tests if name not in quick})
        return {}, {}


def programs_of(tests):
    return sorted({name for programs in tests.values() for name in programs})


def one_of(names):
    """Returns a pattern for ctest that matches exactly these names of tests."""
    return "^(%s)$" % "|".join(re.escape(name) for name in sorted(names))


def run_ctest(*options):
    return run(["ctest", "--test-dir", "build/ci", *CHOICE, "-j", str(os.cpu_count()),
                "--timeout", str(TEST_SECONDS), *options], 3600)


def ctest(*choice):
    """Runs a choice of the unit and picture tests. Returns the first test that fails, or None."""
    code, output = run_ctest("--stop-on-failure", *choice)
    if code == 0:
        return None
    failed = re.findall(r"Test +#\d+: (\S+) .*(?:Failed|Timeout|Exception)", output)
    return failed[0] if failed else "ctest"


def catalogue():
    """Runs the catalogue of hard cases. Returns the first row that fails, or None."""
    code, output = run(["build/ci/" + STABILITY, "--depth", "short"], 400)
    if code == 0:
        return None
    rows = re.findall(r"^(\S+) +\S+ +FAILS", output, re.M)
    return "row %s" % rows[0] if rows else "stability: " + output[-80:]


class Judge:
    """Builds and tests one changed file of the tree."""

    def __init__(self, file, unchanged):
        self.unchanged = unchanged
        self.objects = unchanged.objects.get(str(TREE / file), [])
        self.near, self.folder = unchanged.near_tests(file)
        self.begin = (TREE / file).stat().st_mtime_ns
        self.differs = None  # whether the machine code does, once it is known
        self.changed = {}    # program that was built after the change -> whether its bytes changed

    def is_newer(self, name):
        """True if a file of the build was made after the change. Others are as they were."""
        return (BUILD / name).exists() and (BUILD / name).stat().st_mtime_ns > self.begin

    def affected(self, tests):
        """Returns those tests, of a map to their programs, that the change can affect: those that run
        a program whose bytes changed. The programs must have been built."""
        for name in programs_of(tests):
            if name not in self.changed and self.is_newer(name):
                self.changed[name] = hashes([name])[name] != self.unchanged.programs[name]
        return {test: programs for test, programs in tests.items()
                if any(self.changed.get(program) for program in programs)}

    def test(self, tests):
        """Runs those tests that the change can affect. Returns the first that fails, or None."""
        affected = self.affected(tests)
        return ctest("-R", one_of(affected)) if affected else None

    def build(self, *targets):
        """Builds targets, or all without any, and then looks whether the machine code differs.

        Returns False if the tree does not compile."""
        command = ["cmake", "--build", "--preset", "ci"] + (["--target", *targets] if targets else [])
        if run(command, 1800)[0] != 0:
            return False
        if self.differs is None:
            made = hashes(filter(self.is_newer, self.objects))
            self.differs = any(self.unchanged.hashes[name] != made[name] for name in made) or None
            if made and not self.differs:  # Those that were not built yet decide.
                if run(["cmake", "--build", "--preset", "ci", "--target", *self.objects], 1800)[0] != 0:
                    return False
                made = hashes(self.objects)
                self.differs = any(self.unchanged.hashes[name] != made[name] for name in made)
        return True

    def judge(self):
        """Returns (verdict, by what, stage in which it was caught)."""
        stages = [("near", programs_of(self.near), lambda: self.test(self.near)),
                  ("catalogue", [STABILITY], lambda: self.is_newer(STABILITY) and catalogue()),
                  ("hashes", [HASHES],
                   lambda: self.is_newer(HASHES) and ctest("-R", one_of([os.path.basename(HASHES)]))),
                  ("folder", programs_of(self.folder), lambda: self.test(self.folder)),
                  ("all", [], self.other_tests)]
        for stage, targets, tests in stages:
            if stage in ("near", "folder") and not targets:
                continue
            if not self.build(*targets):
                return "invalid", "does not compile", ""
            if self.differs is False or (stage == "all" and not self.differs):
                return "equivalent", "the same machine code", ""
            failed = self.differs and tests()
            if failed:
                return "caught", failed, stage
        failed = sanitizer(self.affected(self.near), self.is_newer(STABILITY))
        return ("caught", failed, "sanitizer") if failed else ("survived", "", "")

    def other_tests(self):
        """Runs the tests that did not run yet, quick ones first. Returns the first that fails."""
        tests = {name: programs for group in self.unchanged.tests.values()
                 for name, programs in group.items()}
        skipped = {*self.near, *self.folder} | set(tests).difference(self.affected(tests))
        skipped.add("mutants_quote_the_source")  # It compares the source with guards.txt.
        return (ctest("-E", SLOW_TESTS + "|" + one_of(skipped)) or
                ctest("-R", SLOW_TESTS, "-E", one_of(skipped)))


def sanitizer(tests, with_catalogue):
    """Runs tests, which are mapped to their programs, and the catalogue if asked, with the address
    and undefined-behaviour sanitizers, as ./test sanitizers does. Returns what they report, or None."""
    targets = [STABILITY] * with_catalogue + programs_of(tests)
    if not targets:
        return None
    for command in (["cmake", "--preset", "asan", "-DDIP_WERROR=OFF"],
                    ["cmake", "--build", "--preset", "asan", "--target", *targets]):
        if run(command, 1800)[0] != 0:
            return None
    tried = [["build/asan/" + STABILITY, "--depth", "short"]] * with_catalogue
    if tests:
        tried.append(["ctest", "--test-dir", "build/asan", *CHOICE, "-R", one_of(tests),
                      "--output-on-failure"])
    for command in tried:
        code, output = run(command, 1800)
        if code != 0:
            found = re.findall(r"runtime error: .*|ERROR: AddressSanitizer.*|^\S+ +\S+ +FAILS",
                               output, re.M)
            return "sanitizer: " + (found[0] if found else "exit %s" % code)
    return None


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
        verdict, by, stage = "invalid", "the line is not there", ""
    else:
        path.write_text(after)
        try:
            verdict, by, stage = Judge(name, unchanged).judge()
        finally:
            path.write_text(before)
    entry = {"id": identity, "commit": head, "verdict": verdict, "by": by, "stage": stage,
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
    parser.add_argument("--folder", action="append", choices=[*FOLDERS, *OTHER_FOLDERS], metavar="FOLDER",
                        help="take random mutants from this folder only, such as app/report; may be "
                        "given several times")
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
    test_mutants(mutants, count, options.journal, head, Unchanged(head, options.folder or []))
    report(options.journal)


if __name__ == "__main__":
    main()
