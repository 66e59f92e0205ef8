#!/bin/sh
# Runs the documented commands on bare Debian systems: folders made by debootstrap, which have
# nothing but what these commands install.
#
# Usage: bare.sh bookworm|sid [--folder DIR] [--mirror URL] [PART]...
#   --folder DIR   where the systems are made (build/bare/SUITE)
#   --mirror URL   Debian's mirror (http://deb.debian.org/debian)
#
# Without PART, all parts run, in this order:
#   run        ./run in a fresh clone of HEAD: it installs packages, builds, draws, opens the window
#   quick      ./test quick in the same clone
#   packages   cpack there; then the Debian package and the archive, each on a system without
#              compilers, draw the same bits and open a window
#   library    cmake --install there; then tests/install/check_install.sh on a system that has
#              compilers but no sources, with the commands and programs of the installed pages
# The parts packages and library need the system that run has made. The script needs root's rights,
# debootstrap and git, and changes nothing outside the folder. What it mounts is gone when it ends.
set -eu

usage() {
    sed -n '2,/^set -eu/s/^# \{0,1\}//p' "$0" | sed '$d'
}
suite='' folder='' mirror=http://deb.debian.org/debian parts=''
while [ $# -gt 0 ]; do
    case $1 in
    --folder | --mirror)
        [ $# -ge 2 ] || { echo "bare.sh: the value of $1 is missing" >&2; exit 2; }
        [ "$1" = --mirror ] && mirror=$2 || folder=$2
        shift
        ;;
    run | quick | packages | library) parts="$parts $1" ;;
    --help) usage && exit 0 ;;
    -*) echo "bare.sh: no option is called $1; --help lists the options" >&2 && exit 2 ;;
    *) suite=$1 ;;
    esac
    shift
done
[ -n "$suite" ] || { usage >&2; exit 2; }
top=$(cd -P "$(dirname "$0")/../.." && pwd)
folder=${folder:-$top/build/bare/$suite}
for tool in debootstrap git unshare chroot; do
    command -v "$tool" >/dev/null || { echo "bare.sh: $tool is missing" >&2; exit 77; }
done
[ "$(id -u)" = 0 ] || { echo "bare.sh: debootstrap and chroot need root's rights" >&2; exit 77; }
mkdir -p "$folder"
folder=$(cd "$folder" && pwd)

fail() {
    echo "bare.sh: $*" >&2
    exit 1
}

# make_system NAME: makes the system NAME anew, bare.
make_system() {
    if [ ! -d "$folder/bare" ]; then
        rm -rf "$folder/new"
        debootstrap --variant=minbase "$suite" "$folder/new" "$mirror" >"$folder/debootstrap.log" ||
            fail "debootstrap failed; see $folder/debootstrap.log"
        # The mirror may be an archive whose signature is old.
        echo 'Acquire::Check-Valid-Until "false";' >"$folder/new/etc/apt/apt.conf.d/old-archive"
        echo force-unsafe-io >"$folder/new/etc/dpkg/dpkg.cfg.d/fast"
        # Last, so that a system that was left half made is made again.
        mv "$folder/new" "$folder/bare"
    fi
    rm -rf "${folder:?}/$1"
    cp -a "$folder/bare" "$folder/$1"
    inside "$1" 'apt-get -qq update'
}

# inside NAME COMMANDS: runs lines of shell in root's home folder of a system, where `get` installs
# packages. Its processes and mounts end with the last line.
inside() {
    unshare --mount --pid --fork --kill-child sh -ec '
        mount -t proc proc "$1/proc"
        mount -t sysfs sys "$1/sys"
        mount --rbind /dev "$1/dev"
        exec chroot "$1" env -i HOME=/root LANG=C.UTF-8 DEBIAN_FRONTEND=noninteractive \
            PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin \
            ${http_proxy:+http_proxy="$http_proxy"} sh -ec "$2"' sh "$folder/$1" '
        cd
        get() {
            apt-get install -y --no-install-recommends "$@" >get.log 2>&1 ||
                { cat get.log; exit 1; }
        }
        '"$2"
}

# draw NAME COMMAND: writes PNG files of some scenes by a command that starts the program, and
# prints the hashes of their pixels.
draw() {
    inside "$1" "
        for scene in courtyard blend water torture; do
            rm -rf pictures-\$scene
            echo \$scene
            $2 dump --scene \$scene --frames 0:1 --size 320x240 --hash --out pictures-\$scene
            ls pictures-\$scene | grep -q png
        done"
}

# show NAME COMMAND: opens the preview's window under Xvfb, writes its picture and quits.
show() {
    # xvfb-run and xauth belong to the test, not to what ./run needs.
    inside "$1" "get xvfb xauth
        rm -f window.png
        printf '%s\n' '{\"request\":\"screenshot\",\"file\":\"/root/window.png\"}' \
            '{\"request\":\"quit\"}' | timeout 300 xvfb-run -a $2 --control - >window.txt
        [ \$(grep -c '\"ok\":true' window.txt) = 2 ] || { cat window.txt; exit 1; }"
    [ -s "$folder/$1/root/window.png" ] || fail "the preview in $1 wrote no picture of its window"
}

part_run() {
    make_system build
    git clone --quiet "$top" "$folder/build/root/diptych"
    draw build diptych/run >"$folder/hashes"
    show build diptych/run
}

part_quick() {
    inside build 'cd diptych && ./test quick'
}

# documented START: prints the line of docs/install.md that begins with START.
documented() {
    grep "^$1" "$folder/build/root/diptych/docs/install.md"
}

part_packages() {
    inside build "get dpkg-dev; cd diptych
        { $(documented 'cmake --preset'); $(documented 'cpack '); } >/dev/null"
    package=$(echo "$folder"/build/root/diptych/build/release/*.deb)
    make_system deb
    cp "$package" "$folder/deb/root"
    inside deb 'get ./*.deb' # docs/install.md: apt-get install ./diptych_VERSION_ARCHITECTURE.deb
    make_system zip
    cp "${package%/*}"/*.zip "$folder/zip/root"
    needed=$(documented 'apt-get install fonts' | sed 's/^apt-get install//')
    if [ "$suite" != bookworm ]; then # The page has the names of Debian 12.
        needed=$(inside deb "dpkg-deb -f *.deb Depends" | sed 's/([^)]*)//g; s/|[^,]*//g; s/,/ /g')
    fi
    inside zip "get $needed unzip; unzip -q *.zip; mv diptych-*/ diptych"
    for system in 'deb diptych' 'zip diptych/bin/diptych'; do
        set -- $system
        inside "$1" "$2 --version; ! command -v cc || exit 1"
        draw "$1" "$2" | cmp - "$folder/hashes" || fail "the program in $1 draws something else"
        show "$1" "$2"
    done
}

part_library() {
    inside build "cd diptych; { $(documented 'cmake --preset')
        $(documented 'cmake --install' | sed 's|\<DIR\>|/root/installed|'); } >/dev/null"
    make_system library
    # Elsewhere than it was installed, and beside nothing but the tests.
    cp -a "$folder/build/root/installed" "$folder/library/root/copy"
    mkdir -p "$folder/library/root/diptych/tests"
    cp -a "$folder/build/root/diptych/tests/install" "$folder/library/root/diptych/tests"
    ln -s ../copy/share/doc/diptych/docs "$folder/library/root/diptych/docs"
    cp "$folder"/build/root/diptych/build/release/*.deb "$folder/library/root"
    # The Debian package brings what the installed program needs.
    inside library 'get ./*.deb gcc g++ libc6-dev cmake make pkg-config python3-cffi libassimp-dev \
            libcjson-dev libdraco-dev libmeshoptimizer-dev libwebp-dev
        sh diptych/tests/install/check_install.sh ~/diptych ~/copy gcc g++
        sh diptych/tests/install/check_python.sh ~/diptych ~/copy'
}

for part in ${parts:-run quick packages library}; do
    begin=$(date +%s)
    echo "== $suite: $part" >&2
    "part_$part"
    echo "== $suite: $part passed in $(($(date +%s) - begin)) s" >&2
done
