#!/bin/sh
# Runs docs/choosing.py with small pictures. Every row of FLIP in docs/choosing.md must be in its
# table. A front without a set that has a history gives a panel's sets, too.
#
# Usage: choosing.sh DIPTYCH SOURCE_FOLDER
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python=/usr/bin/python3 # Debian's, as in ../program.sh
[ -x "$python" ] || python=python3
"$python" "$2/docs/choosing.py" errors "$1" "$folder/out" --size 48x36 --cache "$folder/cache" >"$folder/table"
sed -n 's/^\(| `*[a-z][^|]*\) | \.[0-9]* | \.[0-9]* | \..*/\1/p' "$2/docs/choosing.md" | tr -d '`' >"$folder/rows"
[ "$(wc -l <"$folder/rows")" -ge 16 ] || { echo "FAILED: the page has no table" >&2; exit 1; }
while read -r row; do
    tr -d '`' <"$folder/table" | grep -qF -- "$row |" || {
        cat "$folder/table"
        echo "FAILED: the table has no row '$row'" >&2
        exit 1
    }
done <"$folder/rows"
"$python" -B -c '
import sys
sys.path.insert(0, sys.argv[1])
import choosing
best = (2, .05, "aa=4")
assert choosing.panel_of([(1, .1, "defaults"), best])[-1] == ("Best", best)' "$2/docs"
echo "all passed"
