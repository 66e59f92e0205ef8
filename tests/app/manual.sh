#!/bin/sh
# Tests that the manual page names every option of every command, that man and groff read it without
# a warning, and that groff prints every example as the help does. Usage: manual.sh DIPTYCH PAGE
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
examples=
for command in preview dump bench cost "cost merge" "cost diff" "cost advise" "cost predict" "path info" "path convert"; do
    printf '%s\n' "$plain" | grep -qx ".SS diptych $command" || fail "there is no section for $command"
    for option in $("$diptych" $command --help | grep -oE '^  --[a-z0-9-]+'); do
        options=$((options + 1))
        printf '%s\n' "$plain" | grep -qE "^\.B $option( |\$)" || fail "the section of $command does not name $option"
    done
    examples="$examples
$("$diptych" $command --help | sed -n '/^Examples:/,/^$/s/^  diptych/diptych/p')"
done
[ "$options" -ge 70 ] || fail "the help names only $options options, expected 70 or more"
[ "$(printf '%s\n' "$examples" | grep -c .)" -ge 20 ] || fail "the help has fewer than 20 examples"
for section in NAME SYNOPSIS DESCRIPTION SETTINGS EXAMPLES "EXIT STATUS"; do
    grep -qx ".SH $section" "$page" || fail "there is no section $section"
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
    # -P-cbou: without colours, bold and underlined text.
    printed=$(groff -man -Tutf8 -rLL=300n -P-cbou "$page" | sed 's/^ *//')
    missing=$(printf '%s\n' "$examples" | grep -vxF -- "$printed")
    [ -z "$missing" ] || fail "groff does not print these examples: $missing"
fi
echo "$options options, read by: $checked; $failures failed"
[ "$failures" = 0 ]
