#!/bin/sh
# Fails when a file includes a header of a library that it may not use or a private header of
# another library, or when the includes between the product's folders have a cycle.
# tests/borders/layers.txt says which libraries a library may use.
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
    function folder_of(path) {
        sub(/\/[^\/]*$/, "", path)
        return path
    }
    # Notes that a folder includes a header of another folder. A source may also include headers of
    # the folders below its own in its library: they hold private parts that the source uses, and
    # they include the headers beside it but never the source.
    function note_folders(header, within,    own, other) {
        own = folder_of(FILENAME)
        other = folder_of(header)
        if (own == other || (within && FILENAME ~ /\.c$/ && index(other, own "/") == 1)) {
            return
        }
        places[own, other] = places[own, other] sprintf("%s:%d: %s includes headers of %s\n",
            FILENAME, FNR, own, other)
    }
    # Drops steps from one folder to another that are in no cycle: again and again, those to a folder
    # that no step leaves, and those from a folder that no step enters. Prints what is left, if there
    # is a cycle.
    function check_folders(    step, ends, leaves, enters, dropped, crossed_folders) {
        do {
            split("", leaves)
            split("", enters)
            for (step in places) {
                split(step, ends, SUBSEP)
                leaves[ends[1]] = enters[ends[2]] = 1
            }
            dropped = 0
            for (step in places) {
                split(step, ends, SUBSEP)
                if (!(ends[2] in leaves) || !(ends[1] in enters)) {
                    delete places[step]
                    dropped++
                }
            }
        } while (dropped)
        for (step in places) {
            if (!crossed_folders++) {
                print "these includes between folders have a cycle:"
            }
            printf "%s", places[step]
            crossed = 1
        }
    }
    BEGIN {
        while ((getline line < LAYERS) > 0) {
            if (line ~ /^#/ || split(line, field) == 0) {
                continue
            }
            allowed[field[1]] = " "
            for (i = 2; i in field; i++) {
                allowed[field[1]] = allowed[field[1]] field[i] " "
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
        if (to != "") {
            note_folders(part[2], to == from)
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
        check_folders()
        if (included < LEAST) {
            printf "only %d includes cross a border; has the tree moved?\n", included
            crossed = 1
        }
        exit crossed
    }'
