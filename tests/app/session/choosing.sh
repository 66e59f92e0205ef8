#!/bin/sh
# Runs docs/choosing.py with small pictures. Every row of docs/choosing.md must be in its table.
#
# Usage: choosing.sh DIPTYCH SOURCE_FOLDER
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 "$2/docs/choosing.py" errors "$1" "$folder/out" --size 48x36 --cache "$folder/cache" >"$folder/table"
sed -n 's/^\(| `*[a-z][^|]*\) | \..*/\1/p' "$2/docs/choosing.md" | tr -d '`' >"$folder/rows"
[ "$(wc -l <"$folder/rows")" -ge 16 ] || { echo "FAILED: the page has no table" >&2; exit 1; }
while read -r row; do
    tr -d '`' <"$folder/table" | grep -qF -- "$row |" || {
        cat "$folder/table"
        echo "FAILED: the table has no row '$row'" >&2
        exit 1
    }
done <"$folder/rows"
echo "all passed"
