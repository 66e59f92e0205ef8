#!/usr/bin/env python3
"""Compares the tables of docs/choosing.md with those that docs/choosing.py printed.

Usage: choosing_page.py rows|values PAGE OUTPUT

Each table of the output must be on the page, under the same heads and with the same rows. `rows`
compares what a row is about, `values` all of its cells. Each other table of the page, except the
list of places, is a table that no command prints. Each FLIP, RMSE and flicker that the page's text
quotes must stand in one of its tables.
"""
import pathlib
import re
import sys

PLACES = ("place", "what is hard there")
FRONTS = ("scene", "settings", "time", "FLIP", "name in a panel")


def tables_of(text):
    """The rows of each table, by its heads."""
    tables, rows = {}, None
    for line in text.splitlines():
        if not line.startswith("|"):
            rows = None
        elif rows is None:
            rows = tables[cells(line)] = []
        elif not line.startswith("|---"):
            rows.append(cells(line))
    return tables


def cells(line):
    return tuple(cell.strip() for cell in line.strip("|").split("|"))


def keys_of(heads, rows):
    """What the rows are about. The sets of a front depend on the machine, but not the names."""
    if heads == FRONTS:
        return sorted((row[0], name) for row in rows for name in row[-1].split(", ") if name)
    return [row[0] for row in rows]


def faults_of(how, page, printed):
    for heads in printed:
        if heads not in page:
            yield f"the page has no table {heads}"
    for heads, rows in page.items():
        if heads == PLACES or (how == "values" and heads not in printed):
            continue
        if heads not in printed:
            yield f"no command prints the page's table {heads}"
        elif how == "values" and rows != printed[heads]:
            yield f"other values in {heads}: {sorted(set(rows) ^ set(printed[heads])) or 'the order'}"
        elif keys_of(heads, rows) != keys_of(heads, printed[heads]):
            here, there = set(keys_of(heads, rows)), set(keys_of(heads, printed[heads]))
            yield f"other rows in {heads}: {sorted(here ^ there) or 'the order'}"


def quotes_of(text):
    """The errors that lines outside of tables quote."""
    for line in text.splitlines():
        if not line.startswith("|"):
            yield from re.findall(r"(?<![\w.])\.\d{4}\b", line)


def main():
    how, page_file, output = sys.argv[1:]
    text = pathlib.Path(page_file).read_text(encoding="utf-8")
    page, printed = tables_of(text), tables_of(pathlib.Path(output).read_text(encoding="utf-8"))
    faults = list(faults_of(how, page, printed))
    if not printed:
        faults.append("no table was printed")
    known = {cell for rows in page.values() for row in rows for cell in row}
    faults += [f"{quote} is in no table of the page" for quote in quotes_of(text) if quote not in known]
    for fault in faults:
        print(f"FAILED: {fault}", file=sys.stderr)
    sys.exit(bool(faults))


if __name__ == "__main__":
    main()
