#!/bin/sh
# Fails when a file includes a header of a library that it may not use, a private header of another
# library, or a header of a folder that stands above its own folder in the same library.
# tests/borders/layers.txt says which libraries a library may use, and how its folders are ordered.
#
# Usage: check_includes.sh LAYERS ROOT [LEAST]
# Also fails when the tree has fewer than LEAST (default 100) includes between libraries.
set -eu
layers=$1
cd "$2"
find renderer config campaths assets app -name '*.[ch]' | sort |
    xargs awk -v LAYERS="$layers" -v LEAST="${3:-100}" '
    function library_of(path,    best, name) {
        best = ""
        for (name in allowed) {
            if (index(path, name "/") == 1 && length(name) > length(best)) {
                best = name
            }
        }
        return best
    }
    # The folder of a file within its library; empty if the file stands at the top of the library.
    function folder_of(path, library,    rest) {
        rest = substr(path, length(library) + 2)
        return rest ~ /\// ? library "/" substr(rest, 1, index(rest, "/") - 1) : ""
    }
    function check_folders(library, includes,    own, other) {
        own = folder_of(FILENAME, library)
        other = folder_of(includes, library)
        if (own == "" || other == "" || own == other) {
            return
        }
        if (!(own in rank) || !(other in rank) || rank[other] > rank[own]) {
            printf "%s:%d: %s may not include headers of %s\n", FILENAME, FNR, own, other
            crossed = 1
        }
    }
    BEGIN {
        while ((getline line < LAYERS) > 0) {
            if (line ~ /^#/ || split(line, field) == 0) {
                continue
            }
            if (sub(/:$/, "", field[1])) {
                ordered[field[1]] = 1
                for (i = 2; i in field; i++) {
                    rank[field[1] "/" field[i]] = i
                }
            } else {
                allowed[field[1]] = " "
                for (i = 2; i in field; i++) {
                    allowed[field[1]] = allowed[field[1]] field[i] " "
                }
            }
            delete field
        }
    }
    FNR == 1 { from = library_of(FILENAME) }
    /^#include "tests\// {
        printf "%s:%d: the product may not include what stands under tests/\n", FILENAME, FNR
        crossed = 1
    }
    /^#include "/ {
        split($0, part, "\"")
        to = library_of(part[2])
        if (to == from && from in ordered) {
            check_folders(from, part[2])
        }
        if (to == "" || to == from) {
            next
        }
        included++
        if (index(allowed[from], " " to "! ")) {
            next
        }
        if (index(allowed[from], " " to " ") == 0) {
            printf "%s:%d: %s may not include headers of %s (%s)\n", FILENAME, FNR, from, to, part[2]
            crossed = 1
        } else if (substr(part[2], length(to) + 2) ~ /\// || part[2] ~ /_(private|parts)\.h$/) {
            printf "%s:%d: %s is a private header of %s\n", FILENAME, FNR, part[2], to
            crossed = 1
        }
    }
    /^#include <SDL2/ && FILENAME !~ /^app\/display\/sdl\// {
        printf "%s:%d: only app/display/sdl/ may include SDL\n", FILENAME, FNR
        crossed = 1
    }
    END {
        if (included < LEAST) {
            printf "only %d includes cross a border; has the tree moved?\n", included
            crossed = 1
        }
        exit crossed
    }'
