#!/bin/sh
# Runs all parts of docs/choosing.py with small pictures, and interrupts them once. The same command must
# continue without measuring anything twice, and the tables must have the rows of docs/choosing.md.
#
# Usage: choosing.sh DIPTYCH SOURCE_FOLDER
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python=/usr/bin/python3 # Debian's, as in ../program.sh
[ -x "$python" ] || python=python3
fail() {
    cat "$folder/table" "$folder/messages"
    echo "FAILED: $1" >&2
    exit 1
}

# A program that notes each of its calls, and fails once when it is called for the ninth time.
cat >"$folder/diptych" <<SCRIPT
#!/bin/sh
echo "\$*" >>"$folder/calls"
[ "\$(wc -l <"$folder/calls")" -ne 9 ] || exit 7
exec "$1" "\$@"
SCRIPT
chmod +x "$folder/diptych"
# The fronts of all combinations take half a minute even so small.
cat >"$folder/small.py" <<SCRIPT
import sys
sys.path.insert(0, "$2/docs")
import choosing
choosing.SPACES = ("aa,af",)
choosing.main()
SCRIPT
# everything TABLE: prints all tables into this file.
everything() {
    "$python" -B "$folder/small.py" everything "$folder/diptych" "$folder/out" --size 40x30 \
        --rounds 2 --starts 1 --samples 1 --cache "$folder/cache" >"$folder/$3" 2>"$folder/messages"
}

everything "$1" "$2" table && fail "a failure of the program is not noticed"
grep -q 'about [1-9][0-9]* min .*: errors 5 min, study ' "$folder/messages" ||
    fail "it does not say how long it will take"
grep -q 'ended with exit code 7; the same command continues' "$folder/messages" ||
    fail "it does not say what failed"
everything "$1" "$2" table || fail "it does not continue"
grep -q 'about .*errors is there' "$folder/messages" || fail "it does not say what is left"
[ "$(sort "$folder/calls" | uniq -d | wc -l)" -eq 1 ] || fail "it measures something twice"
everything "$1" "$2" again && cmp "$folder/table" "$folder/again" || fail "the tables are different now"
grep -q 'about 0 min' "$folder/messages" || fail "something is left to do"
"$python" -B "$2/tests/app/session/choosing_page.py" rows "$2/docs/choosing.md" "$folder/table" ||
    fail "the page and the tables differ"

# A front without a set that has a history gives a panel's sets, too.
"$python" -B -c '
import sys
sys.path.insert(0, sys.argv[1])
import choosing
best = (2, .05, "aa=4")
assert choosing.panel_of([(1, .1, "defaults"), best])[-1] == ("Best", best)' "$2/docs"
echo "all passed"
