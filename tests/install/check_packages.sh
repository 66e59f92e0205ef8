#!/bin/sh
# Makes the archive and the Debian package by the documented command. Both must hold the program
# and its scene but no headers and no libraries, and the package must need the packages that
# docs/install.md names. The test is skipped (exit code 77) on systems without Debian's tools.
#
# Usage: check_packages.sh SOURCE_DIR BUILD_DIR
set -eu
source=$1 build=$2
command -v dpkg-shlibdeps >/dev/null && command -v dpkg-deb >/dev/null ||
    { echo "skipped: no dpkg-shlibdeps or no dpkg-deb (Debian: dpkg-dev)"; exit 77; }
. "$source/tests/install/installed.sh"

rm -f "$build"/diptych-*.zip "$build"/diptych_*.deb
command=$(documented install.md 'cpack ')
without_the_rest
run_quietly "the build cannot be packed" sh -c "$command"
dpkg-deb -x "$build"/diptych_*.deb "$folder/package"
mkdir "$folder/archive"
(cd "$folder/archive" && cmake -E tar xf "$build"/diptych-*.zip)
for root in "$folder/package/usr" "$folder"/archive/*; do
    for file in bin/diptych share/man/man1/diptych.1 share/diptych/assets/courtyard/court.gltf \
        share/doc/diptych/LICENSE share/doc/diptych/copyright; do
        [ -f "$root/$file" ] || fail "$root lacks $file"
    done
    [ ! -e "$root/include" ] && [ ! -e "$root/lib" ] || fail "$root holds headers or libraries"
    "$root/bin/diptych" dump --hash --frames 0:1 | grep -q '^0000 current ' ||
        fail "the program in $root does not draw"
done

[ "$(dpkg-deb -f "$build"/diptych_*.deb Description | wc -l)" -gt 2 ] ||
    fail "the package's description is one line"
dpkg-deb -f "$build"/diptych_*.deb Maintainer | grep -q '^[^<]* <[^ ]*@[^ ]*>$' ||
    fail "the package's maintainer has no address"

# libc is always installed.
needed=$(dpkg-deb -f "$build"/diptych_*.deb Depends | tr ',' '\n' | sed 's/^ *//; s/ .*//; /^$/d' |
    grep -v '^libc6' | sort)
named=$(documented install.md 'apt-get install fonts' | sed 's/apt-get install //' | tr ' ' '\n' | sort)
[ "$needed" = "$named" ] || [ "$(sed -n 's/^VERSION_ID=//p' /etc/os-release)" != '"12"' ] ||
    fail "the package needs: $needed; docs/install.md names: $named"
