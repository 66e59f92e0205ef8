#!/bin/sh
# Checks the headers of an installed copy. Each must compile alone, in C and in C++, and include only
# system headers and <diptych/...>. Whatever a header declares must be exported by a shared library.
#
# Usage: check_headers.sh SOURCE_DIR COPY_DIR COMPILER CXX_COMPILER
set -eu
source=$1 copy=$2 compiler=$3 cxx=$4
. "$source/tests/install/installed.sh"
include=$prefix/include

(cd "$include" && find . -name '*.h' | sed 's|^\./||' | sort) >"$folder/headers"
[ "$(wc -l <"$folder/headers")" -gt 50 ] || fail "there are few headers"
! grep -v '^diptych/' "$folder/headers" || fail "these headers are not in include/diptych"
! grep -rn '#include "' "$include" || fail "these includes could find a header of another program"

# Each header alone, by the oldest documented standards: in strict C without any definition, and in
# C++ with assertions.
while read -r header; do
    printf "#include <%s>\nextern int unused;\n" "$header" >"$folder/header.c"
    cp "$folder/header.c" "$folder/header.cpp"
    "$compiler" -std=c11 -Wall -Wextra -Wpedantic -Werror -fsyntax-only -I"$include" \
        "$folder/header.c" || fail "$header does not compile in C11"
    "$cxx" -std=c++11 -Wall -Wextra -Wpedantic -Werror -DDIP_ASSERTS=1 -fsyntax-only \
        -I"$include" "$folder/header.cpp" || fail "$header does not compile in C++11 with assertions"
done <"$folder/headers"
for page in libraries pipeline; do
    grep -q 'headers need C11 or C++11,' "$source/docs/$page.md" ||
        fail "docs/$page.md does not name the standards that the headers were tested with"
done

nm -D --defined-only "$prefix"/lib*/libdiptych-*.so "$prefix"/lib/*/libdiptych-*.so 2>/dev/null |
    awk 'NF == 3 { print $3 }' | sort -u >"$folder/exported"
(cd "$include" && xargs cat <"$folder/headers") >"$folder/text"
{
    grep -E '^[A-Za-z].*\<dip_[a-z0-9_]+\(' "$folder/text" | grep -vE '^(static|typedef|VEC_INLINE)' |
        sed -E 's/.*\<(dip_[a-z0-9_]+)\(.*/\1/'
    grep -E '^extern .*\<dip_[a-z0-9_]+[[;]' "$folder/text" | sed -E 's/.*\<(dip_[a-z0-9_]+)[[;].*/\1/'
} | sort -u >"$folder/declared"
[ "$(wc -l <"$folder/declared")" -gt 250 ] || fail "few functions were found in the headers"
hidden=$(comm -13 "$folder/exported" "$folder/declared")
[ -z "$hidden" ] || fail "these names are declared but not exported: $hidden"
