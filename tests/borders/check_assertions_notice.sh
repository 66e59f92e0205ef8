#!/bin/sh
# Tests check_assertions.sh: it must accept this tree and refuse small trees with one assertion that
# has an effect.
#
# Usage: check_assertions_notice.sh SOURCE_DIR
set -eu
check="$1/tests/borders/check_assertions.sh"
sh "$check" "$1"
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
mkdir "$folder/renderer" "$folder/config" "$folder/campaths" "$folder/assets" "$folder/app"
write() { # CONDITION
    printf 'void f(void) {\n    DIP_ASSERT(%s);\n}\n' "$1" >"$folder/app/made.c"
}
must_refuse() { # CONDITION
    write "$1"
    if sh "$check" "$folder" 1; then
        echo "not refused: DIP_ASSERT($1)"
        exit 1
    fi
}
must_refuse 'dip_quality_parse(text, &quality, NULL)'
must_refuse 'a == 1 &&
               open_it()'
must_refuse 'count++ < 3'
must_refuse 'a = 1'
write 'a <= 1 && (b != 2 ||
               dip_isa_available(isa)) && sizeof(int) >= c->d[e]'
sh "$check" "$folder" 1
