#!/bin/sh
# Fails when a condition of DIP_ASSERT assigns, counts or calls a function that is not known to be
# pure: the program that users get does not evaluate it.
#
# Usage: check_assertions.sh ROOT [LEAST]
# Also fails when the tree has fewer than LEAST (default 40) assertions.
set -eu
cd "$1"
find renderer config campaths assets app -name '*.[ch]' | sort |
    xargs awk -v LEAST="${2:-40}" '
    BEGIN {
        split("sizeof DIP_ARRAY_COUNT dip_isa_available dip_patch_count dip_cost_term_count", names, " ")
        for (i in names) {
            pure[names[i]] = 1
        }
    }
    function refuse(what) {
        printf "%s:%d: DIP_ASSERT %s: %s\n", file, line, what, condition
        refused = 1
    }
    function judge(    rest, name) {
        checked++
        rest = condition
        while (match(rest, /[A-Za-z_][A-Za-z_0-9]*[ ]*\(/)) {
            name = substr(rest, RSTART, RLENGTH - 1)
            gsub(/ /, "", name)
            if (!(name in pure)) {
                refuse("calls " name)
            }
            rest = substr(rest, RSTART + RLENGTH)
        }
        rest = condition
        gsub(/[=!<>]=/, "", rest)
        if (rest ~ /=|\+\+|--/) {
            refuse("has an effect")
        }
    }
    # Adds the characters of a line to the condition until its last parenthesis closes.
    function take(text,    i, c) {
        for (i = 1; i <= length(text) && depth > 0; i++) {
            c = substr(text, i, 1)
            depth += (c == "(") - (c == ")")
            condition = condition (depth > 0 ? c : "")
        }
        if (depth == 0) {
            judge()
        }
    }
    FNR == 1 { depth = 0 }
    depth > 0 { take($0); next }
    /DIP_ASSERT\(/ && !/#define/ {
        file = FILENAME
        line = FNR
        condition = ""
        depth = 1
        take(substr($0, index($0, "DIP_ASSERT(") + 11))
    }
    END {
        if (checked < LEAST) {
            printf "only %d assertions; has the tree moved?\n", checked
            refused = 1
        }
        exit refused
    }'
