#!/bin/sh
# Tests the table of compare.sh with results that were made up.
#
# Usage: test_compare.sh SOURCE_DIR
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
line() { # LABEL SIZE ROW PEER_MS OURS_MS RATIO PEER
    printf '%s\tname\t9\t%s\t%s\t%s\t%s\t%s\t1.5\t2.5\t44.0\t%s\tabc123\tavx2\t2\tAMD\n' "$@"
}
{
    line system-gl:city 640x480 none 40 10 4.0 "llvmpipe, Mesa 22"
    line newest-gl:city 640x480 none 20 10 2.0 "llvmpipe, Mesa 26"
    line newest-gl:grid=1000 640x480 none 4 8 0.5 "llvmpipe, Mesa 26"
} >"$folder/results"
sh "$1/tests/peer/compare.sh" --table --results "$folder/results" >"$folder/table"
expect() { # PATTERN
    if ! grep -qE "$1" "$folder/table"; then
        echo "the table has no line like '$1':"
        cat "$folder/table"
        exit 1
    fi
}
expect '^Diptych at commit abc123, avx2, 2 threads each, AMD$'
expect '^system-gl +llvmpipe, Mesa 22$'
expect '^city +640x480 +none +newest-gl +20.00 +10.00 +2.00 +1.50 to 2.50 +44.0 +4.00 +2.00$'
expect '^grid=1000 +640x480 +none +newest-gl +4.00 +8.00 +0.50 +1.50 to 2.50 +44.0 +- +0.50$'
# The means of 2 and 0.5, of 4 alone, and of 2 and 0.5.
expect '^geometric mean +1.00 +4.00 +1.00$'
expect '^Diptych is behind the strongest peer in 1 of 2 rows.$'
