# What the tests of this folder share. They source this file, with the variable source, and with copy
# if they test an installed copy, or with build. Then $folder is a folder for the test's files, and
# $prefix is the copy, or the folder into which the documented command installs the build.

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
prefix=${copy:-$folder/prefix}

fail() {
    echo "$*"
    exit 1
}

# run_quietly WHAT COMMAND...: shows the command's output only if it fails.
run_quietly() {
    what=$1
    shift
    "$@" >"$folder/log" 2>&1 || { cat "$folder/log"; fail "$what"; }
}

# without_the_rest: takes the manual page from the build, as if ./run had made it, which builds the
# program alone. Installing and packing must build the rest first.
without_the_rest() {
    rm "$build/diptych.1"
}

# documented PAGE START: prints the line of a page that begins with START, for this installed copy.
documented() {
    line=$(grep -F -- "$2" "$source/docs/$1" | grep "^$2" | head -1)
    [ -n "$line" ] || fail "docs/$1 has no line that begins with: $2"
    echo "$line" >>"$folder/documented"
    echo "$line" | sed "s|build/release|${build:-}|g; s|\<DIR\>|$prefix|g"
}
