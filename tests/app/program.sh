# What the tests of the program's commands share. A test sources this file first: its first argument
# is the program, $diptych from here on. The test gets a working folder of its own, which is removed
# when it ends. It ends with finish.
set -u
diptych=$1
folder=$(mktemp -d) || exit 1
trap 'rm -rf "$folder"' EXIT
cd "$folder" || exit 1
failures=0
checks=0

# Debian's interpreter, as in the tests that are written in Python. Another python3 that comes first in
# PATH may be a script, whose start takes longer than what it computes here.
python3() {
    if [ -x /usr/bin/python3 ]; then
        /usr/bin/python3 "$@"
    else
        command python3 "$@"
    fi
}

# fail TEXT [FILE]: counts a fault and prints it, with the file's lines if there are any. Without
# FILE, it prints what the last command wrote to standard error.
fail() {
    failures=$((failures + 1))
    echo "FAILED: $1"
    [ ! -s "${2:-err.txt}" ] || sed 's/^/  | /' "${2:-err.txt}"
}

# check DESCRIPTION COMMAND...: the command must succeed.
check() {
    description=$1
    shift
    checks=$((checks + 1))
    "$@" >check.txt 2>&1 || fail "$description" check.txt
}

# expect CODE REGEX COMMAND...: the command must end with this exit code, and a line of its standard
# error must match. If the code says that the input is wrong (2), there must be one line only, or
# $most_lines. The command's outputs are in out.txt and err.txt.
expect() {
    code=$1
    regex=$2
    shift 2
    "$@" >out.txt 2>err.txt
    found=$?
    checks=$((checks + 1))
    if [ "$found" != "$code" ] || { [ -n "$regex" ] && ! grep -qE -- "$regex" err.txt; }; then
        fail "expected exit code $code and /$regex/, found $found and the lines below: $*"
    elif [ "$code" = 2 ] && [ "$(wc -l <err.txt)" -gt "${most_lines:-1}" ]; then
        fail "more than one line for one fault: $*"
    fi
}

# refuse REGEX ARGUMENT...: the program must refuse its input with one line that matches.
refuse() {
    regex=$1
    shift
    expect 2 "$regex" "$diptych" "$@"
}

# has REGEX [FILE]: a line of the file must match. Without FILE, it is what the last command printed.
has() {
    checks=$((checks + 1))
    grep -qE -- "$1" "${2:-out.txt}" || fail "no line matches /$1/" "${2:-out.txt}"
}

finish() {
    echo "$checks checks, $failures failed"
    [ "$failures" = 0 ]
    exit
}
