#!/bin/sh
# Fails if a library exports a name that does not begin with dip_. Weak names (types W and V of nm) are
# left out: they are the compiler's copies of inline C++ functions of other libraries' headers, which
# the linker merges.
# Usage: exported_names.sh LIBRARY...
set -eu
names=$(nm -g --defined-only "$@" 2>/dev/null | awk 'NF == 3 && $2 !~ /^[WV]$/ { print $3 }')
[ "$(echo "$names" | wc -l)" -gt 100 ] || { echo "nm found 100 names or fewer; were all libraries given?"; exit 1; }
foreign=$(echo "$names" | grep -vE '^dip_|^__(asan|ubsan|tsan|odr_asan)' || true)
[ -z "$foreign" ] || { echo "these exported names do not begin with dip_: $foreign"; exit 1; }
