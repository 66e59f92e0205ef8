"""Lists the tests that did not run, with their reasons: skipped.py BUILD_FOLDER RESULTS_FOLDER.

Reads left_out.txt of each build, which names what CMake left out, and the results of ctest
(PRESET.xml after a number and a hyphen). A skipped test says in its last line why it is skipped;
a test of cmocka that skips some of its functions names them.
"""
import pathlib
import re
import sys
import xml.etree.ElementTree


def reasons(case):
    """Yields why a test, or a part of it, did not run."""
    lines = [line for line in (case.findtext("system-out") or "").splitlines() if line.strip()]
    if case.find("skipped") is not None:
        yield lines[-1].strip() if lines else "it gives no reason"
    for line in lines:
        found = re.match(r"\[  SKIPPED \] (\w+)", line)
        if found:
            yield f"{found[1]} does not apply to this machine"


def main():
    build, results = map(pathlib.Path, sys.argv[1:3])
    said = []
    for file in sorted(results.glob("*.xml"), key=lambda file: int(file.name.split("-")[0])):
        preset = file.stem.split("-", 1)[1]
        left_out = build / preset / "left_out.txt"
        if left_out.exists():
            said += [(line, preset) for line in left_out.read_text("utf-8").splitlines()]
        for case in xml.etree.ElementTree.parse(file).iter("testcase"):
            said += [(f"{case.get('name')}: {reason}", preset) for reason in reasons(case)]
    if said:
        print("\nNot run:")
    for text in dict.fromkeys(text for text, _ in said):
        presets = dict.fromkeys(preset for other, preset in said if other == text)
        print(f"  {text} ({', '.join(presets)})")


main()
