#!/bin/sh
# The manual page: it names every option of every command, and the tools that read it find no fault.
# Usage: manual.sh DIPTYCH PAGE
set -u
diptych=$1
page=$2
failures=0

fail() {
    failures=$((failures + 1))
    echo "FAILED: $*"
}

[ -s "$page" ] || fail "there is no page $page"
plain=$(sed 's/\\-/-/g' "$page")
options=0
for command in preview dump bench cost "cost merge" "cost assets" "path info" "path convert"; do
    printf '%s\n' "$plain" | grep -qx ".SS diptych $command" || fail "no section on $command"
    for option in $("$diptych" $command --help | grep -oE '^  --[a-z-]+'); do
        options=$((options + 1))
        printf '%s\n' "$plain" | grep -qE "^\.B $option( |\$)" || fail "no $option of $command"
    done
done
[ "$options" -ge 70 ] || fail "the help names only $options options"
for section in NAME SYNOPSIS DESCRIPTION SETTINGS EXAMPLES "EXIT STATUS"; do
    grep -qx ".SH $section" "$page" || fail "no section $section"
done

checked=no
if command -v man >/dev/null; then
    checked=man
    warnings=$(LC_ALL=C.UTF-8 MANROFFSEQ='' MANWIDTH=80 man --warnings -E UTF-8 -l -Tutf8 -Z "$page" \
        2>&1 >/dev/null)
    [ -z "$warnings" ] || fail "man warns: $warnings"
fi
if command -v groff >/dev/null; then
    checked="$checked groff"
    warnings=$(groff -man -Tutf8 -ww -z "$page" 2>&1)
    [ -z "$warnings" ] || fail "groff warns: $warnings"
fi
echo "$options options, read by: $checked; $failures failed"
[ "$failures" = 0 ]
