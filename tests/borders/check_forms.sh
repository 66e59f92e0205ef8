#!/bin/sh
# Fails when a form of a report (JSON, CSV, text, page) computes what it shows, when a loop finds a
# row by its settings although dip_report_find does, or when the spread between runs is said in
# other words than by dip_cost_level_text.
#
# Usage: check_forms.sh ROOT
set -eu
cd "$1"
failed=0
forms=$(find app/report/format app/report/page app/cost -name '*.c' |
    grep -E '/format/|/page/|_output\.c$|_table\.c$' | sort)
if test "$(echo "$forms" | wc -l)" -lt 15; then
    echo "only $(echo "$forms" | wc -l) sources of forms; has the tree moved?"
    failed=1
fi
if grep -nE '(^|[^a-z_])dip_(cost_(fit|analyse|interactions|choose)|front|front_knee|advise) *\(' $forms ||
    grep -n 'report/fit\.h' $forms; then
    echo "these lines of forms analyse a report"
    failed=1
fi
# The comparison of two reports has rules of its own for rows.
sources=$(find app/report app/cost app/bench app/preview -name '*.c' | grep -v 'app/report/report\.c\|app/cost/diff/')
if grep -nE '(memcmp|dip_quality_equal)\(&[a-z>-]*(rows|list)\[[a-z]\]\.quality, (quality|wanted)[,)]' $sources; then
    echo "these lines find a row by hand and not with dip_report_find"
    failed=1
fi
if grep -nE '0\.006[^0-9]|by a tenth|10 %% off' $sources; then
    echo "these lines say how far runs differ; dip_cost_level_text does"
    failed=1
fi
exit $failed
