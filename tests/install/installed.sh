# Installs a build into a new folder. The tests of this folder source this file, with the variables
# source and build. Then $prefix is the installed copy and $folder a folder for the test's files. If
# build is no build but an installed copy, it serves as it is. With the variable packed, nothing is
# installed and $prefix is empty.

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
prefix=$folder/prefix

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

# documented PAGE START: prints the line of a page that begins with START, for this installed copy.
documented() {
    line=$(grep -F -- "$2" "$source/docs/$1" | grep "^$2" | head -1)
    [ -n "$line" ] || fail "docs/$1 has no line that begins with: $2"
    echo "$line" >>"$folder/documented"
    echo "$line" | sed "s|build/release|$build|g; s|\<DIR\>|$prefix|g"
}

if [ -n "${packed:-}" ]; then
    prefix=
elif [ -f "$build/CMakeCache.txt" ]; then
    # The files move after they are installed: nothing in them may name the folder.
    command=$(documented install.md 'cmake --install')
    run_quietly "the build cannot be installed" sh -c "$command"
    mv "$prefix" "$folder/moved"
    prefix=$folder/moved
else
    prefix=$build
fi
