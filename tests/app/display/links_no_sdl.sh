#!/bin/sh
# Fails if anything but app/display/sdl/ and its tests includes SDL, calls it or links it.
# Usage: links_no_sdl.sh TOP SDL_LIBRARY PREVIEW_TEST LIBRARY...
set -eu
top=$1
sdl_library=$2
preview_test=$3
shift 3

# If nm does not find SDL's functions in the library that calls them, the check below proves
# nothing.
nm -u "$sdl_library" | grep -q ' SDL_' || { echo "nm finds no call of SDL in $sdl_library"; exit 1; }
for library in "$@"; do
    if nm -u "$library" | grep -E ' (SDL|TTF)_'; then
        echo "$library calls SDL"
        exit 1
    fi
done
if ldd "$preview_test" | grep -i 'libSDL'; then
    echo "$preview_test links SDL"
    exit 1
fi
includers=$(grep -rlE '#include [<"]SDL' "$top/app" "$top/renderer" "$top/config" "$top/campaths" \
    "$top/assets" "$top/tests" --include='*.[ch]' | grep -vE "^$top/(app|tests/app)/display/sdl/" || true)
[ -z "$includers" ] || { echo "includes SDL outside app/display/sdl/: $includers"; exit 1; }
