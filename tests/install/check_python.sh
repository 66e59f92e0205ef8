#!/bin/sh
# Draws with an installed copy from Python by the documented command. The test is skipped (exit code
# 77) if no Python has cffi.
#
# Usage: check_python.sh SOURCE_DIR COPY_DIR
set -eu
source=$1 copy=$2
interpreter=
for python in python3 /usr/bin/python3; do
    ! "$python" -c 'import cffi' 2>/dev/null || interpreter=$(command -v "$python")
done
[ -n "$interpreter" ] || { echo "skipped: no cffi (Debian: python3-cffi)"; exit 77; }
. "$source/tests/install/installed.sh"

# The command calls the Python that has cffi.
mkdir "$folder/bin"
ln -s "$interpreter" "$folder/bin/python3"
command=$(documented libraries.md 'python3 ')
cd "$folder"
shown=$(PATH=$folder/bin:$PATH sh -c "$command")
[ "$shown" = "1228800 samples shown" ] || fail "the example in Python printed: $shown"
[ "$(od -A n -t x1 -N 24 courtyard.png | tr -d ' \n')" = \
    89504e470d0a1a0a0000000d4948445200000280000001e0 ] ||
    fail "the example in Python writes no PNG of 640x480 pixels"
