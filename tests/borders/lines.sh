#!/bin/sh
# Counts the lines of C outside tests/, by folder, at a revision.
#
# Usage: lines.sh [REVISION]   (default: HEAD)
set -eu
cd "$(dirname "$0")/../.."
revision=${1:-HEAD}
git ls-tree -r --name-only "$revision" | grep -E '^(renderer|config|campaths|assets|app)/.*\.[ch]$' |
    while read -r file; do
        echo "$file $(git show "$revision:$file" | wc -l)"
    done | awk '
    {
        folder = $1
        sub(/\/[^\/]*$/, "", folder)
        lines[folder] += $2
        files[folder]++
        top = $1
        sub(/\/.*/, "", top)
        all[top] += $2
    }
    END {
        for (folder in lines) {
            printf "%7d lines %4d files  %s\n", lines[folder], files[folder], folder | "sort -k5"
        }
        close("sort -k5")
        for (top in all) {
            printf "%7d lines in all of %s\n", all[top], top
        }
    }'
