#!/bin/sh
# Fails if the tree is not divided as its map says: a line of tests/borders/layers.txt that names a
# library below it, a library of more than 15 % of the product's lines, a folder of more than 30
# files, or a product file that belongs to no library.
#
# Usage: check_rooms.sh LAYERS ROOT
set -eu
layers=$1
cd "$2"
find renderer config campaths assets app -name '*.[ch]' | sort | xargs wc -l | awk -v LAYERS="$layers" '
    BEGIN {
        while ((getline line < LAYERS) > 0) {
            if (line ~ /^#/ || split(line, field) == 0) {
                continue
            }
            for (i = 2; i in field; i++) {
                sub(/!$/, "", field[i])
                if (!(field[i] in known)) {
                    printf "%s names %s, which does not stand above it\n", field[1], field[i]
                    wrong = 1
                }
            }
            known[field[1]] = 1
            delete field
        }
    }
    $2 == "total" { next }
    {
        best = ""
        for (name in known) {
            if (index($2, name "/") == 1 && length(name) > length(best)) {
                best = name
            }
        }
        if (best == "") {
            printf "%s belongs to no library of layers.txt\n", $2
            wrong = 1
        }
        lines[best] += $1
        all += $1
        folder = $2
        sub(/\/[^\/]*$/, "", folder)
        files[folder]++
    }
    END {
        for (name in lines) {
            if (lines[name] > 0.15 * all) {
                printf "%s holds %d of the %d lines, more than 15 %%\n", name, lines[name], all
                wrong = 1
            }
        }
        for (folder in files) {
            if (files[folder] > 30) {
                printf "%s holds %d files, more than 30\n", folder, files[folder]
                wrong = 1
            }
        }
        exit wrong
    }'
