#!/usr/bin/env python3
"""Compares the hashes of Diptych's pictures of the models of make_models.py with a list.

Usage: hashes.py DIPTYCH LIST [--write | --all-ways]

The list holds the pictures that beside.py has compared with those of three.js. They are drawn with
the scalar kernels on one thread, and with all effects forced by the best instruction set on three;
with --all-ways also as planned by each instruction set that this machine has, on two. --write writes
the list; then run beside_models.sh, too. The exit code is 77 if numpy is missing.
"""
import pathlib
import subprocess
import sys

import ours

WAYS = (("--isa", "scalar", "--threads", "1"),
        ("--isa", "auto", "--threads", "3", "--force-all-effects"))
SETS = ("sse2", "avx2", "avx512", "neon")


def ways_of(diptych):
    """WAYS, and each instruction set on two threads if the program can use it here."""
    ways = list(WAYS)
    for isa in SETS:
        way = ("--isa", isa, "--threads", "2")
        if subprocess.run([diptych, "dump", "--hash", "--size", "16x12", *way], check=False,
                          capture_output=True).returncode == 0:
            ways.append(way)
    return ways


def draw_all(diptych, way):
    """Returns the lines of the list."""
    lines = []
    with ours.make_models() as folder:
        for model in ours.find_models(folder):
            for n, view in enumerate(model.views):
                found, said, _ = ours.draw(diptych, model, view, way)
                lines.append(f"{model.name} {n} {found or said}".strip())
    return lines


def main():
    try:
        import numpy  # pylint: disable=unused-import,import-outside-toplevel
    except ImportError as missing:
        print(f"skipped: {missing}")
        return 77
    diptych, file = sys.argv[1], pathlib.Path(sys.argv[2])
    if sys.argv[3:] == ["--write"]:
        file.write_text("\n".join(draw_all(diptych, WAYS[0])) + "\n")
        return 0
    expected = file.read_text().splitlines()
    faults = 0
    for way in ways_of(diptych) if sys.argv[3:] == ["--all-ways"] else WAYS:
        lines = draw_all(diptych, way)
        differ = [f"drawn:  {line}" for line in lines if line not in expected]
        differ += [f"listed: {line}" for line in expected if line not in lines]
        faults += len(differ)
        print("\n".join([" ".join(way), f"{len(lines)} pictures", *differ]))
    return 1 if faults else 0


sys.exit(main())
