#!/usr/bin/env python3
"""Checks that the program takes the options of every command that README.md and docs/ show.

Usage: documented_commands.py DIPTYCH TOP

Each command is given an option more that no command has. The program reads options in their order,
so it must name this option in its message, and no other word of the command. Nothing runs. A word
in capitals, such as FILE, stands for something of the reader's; N stands for a number. Commands with
variables of the shell are left out (tests/app/cost/machines.sh runs them).
"""
import pathlib
import re
import shlex
import subprocess
import sys

UNKNOWN = "--not-an-option"
BEGIN = re.compile(r"^(\./run|(?:\S*/)?diptych)(?= |$)")
LEAST = 50  # Commands that the pages have, so that a fault of this script does not go unnoticed.


def blocks(text):
    """The lines of the code blocks of a page, those with a backslash at the end joined."""
    inside = False
    for line in text.replace("\\\n", " ").splitlines():
        if line.startswith("```"):
            inside = not inside
        elif inside or line.startswith("    "):
            yield line.strip()


def words_of(line):
    """The words of the command behind the program's name, or None for another line."""
    line = re.sub(r"^(\$ |timeout \S+ |sudo )", "", line)
    found = BEGIN.match(line)
    if not found:
        return None
    try:
        words = shlex.split(line[found.end():], comments=True)
    except ValueError:
        return None
    ends = [i for i, word in enumerate(words) if re.match(r"[0-9]?[<>|&;]", word)]
    return words[:ends[0]] if ends else words


def main():
    diptych, top = sys.argv[1], pathlib.Path(sys.argv[2])
    count, faults = 0, 0
    for page in (top / "README.md", *sorted((top / "docs").glob("*.md"))):
        for line in blocks(page.read_text()):
            words = words_of(line)
            if words is None or any("$" in word for word in words):
                continue
            count += 1
            words = ["3" if word == "N" else word for word in words]
            done = subprocess.run([diptych, *words, UNKNOWN], capture_output=True, text=True,
                                  check=False, stdin=subprocess.DEVNULL)
            if done.returncode != 2 or UNKNOWN not in done.stderr:
                faults += 1
                print(f"{page.name}: {line}\n    {done.stderr.strip() or done.returncode}")
    print(f"{count} commands, {faults} not taken")
    return 1 if faults or count < LEAST else 0


sys.exit(main())
