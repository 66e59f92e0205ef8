#!/bin/sh
# Runs the program where /proc cannot be read, so that Linux does not tell where the program lies: it
# must find its ini and its importer all the same. Usage: no_proc.sh DIPTYCH
. "$(dirname "$0")/program.sh"

# without_proc COMMAND...: runs the command in a mount namespace whose /proc is empty.
without_proc() {
    unshare $as_root --mount sh -ec 'mount -t tmpfs none /proc; exec "$@"' sh "$@"
}

as_root=
if ! without_proc true 2>/dev/null; then
    as_root='--user --map-root-user'
    if ! without_proc true 2>unshare.txt; then
        echo "skipped: this system lets no test hide /proc: $(cat unshare.txt)"
        exit 77
    fi
fi

"$diptych" dump --hash --size 64x48 >expected.txt || fail "the courtyard is not drawn"
if without_proc test -e /proc/self; then
    fail "/proc is not hidden"
fi
without_proc "$diptych" dump --hash --size 64x48 >found.txt 2>err.txt || fail "no ini or importer is found"
check "the pictures are the same without /proc" cmp expected.txt found.txt

# By a link and by a relative name.
ln -s "$diptych" link
without_proc ./link dump --hash --size 64x48 >linked.txt 2>err.txt || fail "a link does not find them"
check "the pictures are the same by a link" cmp expected.txt linked.txt
finish
