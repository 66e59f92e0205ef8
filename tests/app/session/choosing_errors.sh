#!/bin/sh
# Measures the errors of docs/choosing.md by its commands. The tables on the page must have the same
# values. It takes about ten minutes.
#
# Usage: choosing_errors.sh DIPTYCH SOURCE_FOLDER [FOLDER of reports that are there already]
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python=/usr/bin/python3 # Debian's, as in ../program.sh
[ -x "$python" ] || python=python3
for part in errors study; do
    "$python" -B "$2/docs/choosing.py" $part "$1" "${3:-$folder/out}" --cache "$folder/cache"
done >"$folder/tables"
"$python" -B "$2/tests/app/session/choosing_page.py" values "$2/docs/choosing.md" "$folder/tables"
echo "all passed"
