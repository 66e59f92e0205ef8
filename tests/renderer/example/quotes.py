#!/usr/bin/env python3
"""Checks that every block of C code in a document stands, line by line, in a source file. Whole
programs are left out: tests/install/ compiles and runs the one of docs/pipeline.md.

    quotes.py DOCUMENT.md SOURCE.c

Indentation does not count: a quoted function body may start at the left margin.
"""
import sys


def blocks_of(document):
    """Returns (line number, lines) of each block that starts with ```c."""
    found, block = [], None
    for number, line in enumerate(open(document, encoding="utf-8"), 1):
        if block is None and line.rstrip() == "```c":
            block = (number, [])
        elif block is not None and line.startswith("```"):
            found.append(block)
            block = None
        elif block is not None:
            block[1].append(line.strip())
    return found


def main():
    document, source = sys.argv[1:]
    code = [line.strip() for line in open(source, encoding="utf-8")]
    blocks = [(number, lines) for number, lines in blocks_of(document)
              if not any(line.startswith("int main(") for line in lines)]
    missing = [number for number, lines in blocks
               if not any(code[at:at + len(lines)] == lines for at in range(len(code)))]
    for number in missing:
        print("%s:%d: this code does not stand in %s" % (document, number, source))
    if not blocks:
        print("%s quotes nothing" % document)
    return 1 if missing or not blocks else 0


if __name__ == "__main__":
    sys.exit(main())
