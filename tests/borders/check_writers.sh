#!/bin/sh
# Fails when a source of the report's page, of a plot or of a form for the terminal writes by itself
# and not through app/files/put.h, which escapes what it inserts. Only the sources that hold
# style, scripts or SVG attributes may write markup unchanged.
#
# Usage: check_writers.sh ROOT
set -eu
cd "$1"
sources=$(find app -name 'html*.c' -o -name '*_html.c' -o -name 'form.c' -o -name 'sections.c' -o -path '*/page/*.c' -o -name 'plot.c' |
    grep -v '^app/preview/\|/put\.c$' | sort)
tables=$(find app/cost app/report -name '*table.c' -o -name 'merge_machines.c' -o -name '*_text.c')
failed=0
if test "$(echo "$sources" | wc -l)" -lt 5; then
    echo "only $(echo "$sources" | wc -l) sources of the page; has the tree moved?"
    failed=1
fi
if grep -nE '(^|[^a-z_])(v?f?printf|f?puts|f?putc|putchar|fwrite|write) *\(' $sources $tables; then
    echo "these lines write text without app/files/put.h"
    failed=1
fi
if grep -nE 'dip_put_markup\(out, [^")]*\)' $sources | grep -vE '(\(const char \*\)(styles|scripts)\[i\]|attributes|style)\)'; then
    echo "these lines write a text as markup"
    failed=1
fi
# A value is passed as a value, not read back from its text.
if grep -rn 'sscanf *(' app/preview app/report app/ui; then
    echo "these lines read a text that the program itself wrote, or should use a reader"
    failed=1
fi
exit $failed
