#!/bin/sh
# Makes a folder with the newest Mesa of Debian, and runs a program against that Mesa.
#
# Usage: newest.sh [--suite sid|trixie] [--folder DIR] [--mirror URL] [PROGRAM [ARGUMENT]...]
#   --suite NAME   Debian's suite (sid)
#   --folder DIR   the folder (build/newest-SUITE); it is made if it has no Mesa yet
#   --mirror URL   Debian's mirror (http://deb.debian.org/debian)
#
# The folder gets Mesa's llvmpipe (OpenGL) and lavapipe (Vulkan) and every library that they need,
# libc among them. PROGRAM is a program of this machine: the folder's own dynamic loader starts it,
# so that it uses the folder's libraries. It needs neither root's rights nor chroot nor mount, only
# apt-get and dpkg-deb, and changes nothing outside the folder. Without PROGRAM, the script prints
# the versions. To fetch Mesa again, delete the folder.
set -eu

suite=sid
folder=
mirror=http://deb.debian.org/debian
usage() {
    sed -n '2,/^set -eu/s/^# \{0,1\}//p' "$0"
}
need_value() { # OPTION NUMBER_OF_ARGUMENTS
    if [ "$2" -lt 2 ]; then
        echo "newest.sh: the value of $1 is missing" >&2
        exit 2
    fi
}
while [ $# -gt 0 ]; do
    case $1 in
    --suite) need_value "$1" $# && suite=$2 && shift 2 ;;
    --folder) need_value "$1" $# && folder=$2 && shift 2 ;;
    --mirror) need_value "$1" $# && mirror=$2 && shift 2 ;;
    --help) usage && exit 0 ;;
    -*) echo "newest.sh: no option is called $1; --help lists the options" >&2 && exit 2 ;;
    *) break ;;
    esac
done
if [ -z "$folder" ]; then
    folder=$(cd "$(dirname "$0")/../.." && pwd)/build/newest-$suite
fi

# Prints the path of a file that the pattern describes, or fails.
find_file() { # PATTERN
    found=$(find "$folder/root" -path "$1" ! -type d 2>/dev/null | head -n 1)
    test -n "$found" && echo "$found"
}

# Writes the settings of an apt-get that knows no package of this machine, so that it fetches every
# library that Mesa needs. The mirror may be an archive whose signature is old; the signature is
# checked, its age is not.
configure_apt() {
    mkdir -p apt/state/lists/partial apt/cache/archives/partial apt/etc/apt.conf.d \
        apt/etc/preferences.d apt/etc/trusted.gpg.d
    : >apt/status
    cat >apt/apt.conf <<END
Dir "$folder/apt";
Dir::State "$folder/apt/state";
Dir::State::status "$folder/apt/status";
Dir::Cache "$folder/apt/cache";
Dir::Etc "$folder/apt/etc";
Dir::Log "$folder/apt";
APT::Install-Recommends "false";
APT::Sandbox::User "";
Acquire::Languages "none";
Acquire::Check-Valid-Until "false";
END
    echo "deb [signed-by=/usr/share/keyrings/debian-archive-keyring.gpg] $mirror $suite main" \
        >apt/etc/sources.list
}

make_folder() {
    for tool in apt-get dpkg-deb; do
        if ! command -v "$tool" >/dev/null; then
            echo "newest.sh: $tool is missing; the script needs Debian or a system like it" >&2
            exit 77
        fi
    done
    echo "newest.sh: fetching Mesa of Debian $suite into $folder (about 85 MB)" >&2
    mkdir -p "$folder"
    folder=$(cd "$folder" && pwd)
    (
        cd "$folder"
        configure_apt
        export APT_CONFIG="$folder/apt/apt.conf"
        apt-get -qq update
        apt-get -qq -y --download-only install libegl1 libegl-mesa0 libgl1-mesa-dri libvulkan1 \
            mesa-vulkan-drivers >/dev/null
        rm -rf new
        mkdir new
        # Debian's older packages have files in /lib, its newer ones in /usr/lib. Both are one folder.
        mkdir new/usr new/usr/lib new/usr/lib64 new/usr/bin new/usr/sbin
        for name in lib lib64 bin sbin; do
            ln -s "usr/$name" "new/$name"
        done
        for package in apt/cache/archives/*.deb; do
            dpkg-deb --fsys-tarfile "$package" | tar -x --keep-directory-symlink -C new
            dpkg-deb --field "$package" Package Version | sed 's/^[^:]*: //' | tr '\n' ' '
            echo
        done >versions
        rm -rf apt root
        mv new root # Last, so that a folder that was left half made is made again.
    )
}

test -d "$folder/root" || make_folder
folder=$(cd "$folder" && pwd)
if [ $# -eq 0 ]; then
    grep -E '^(mesa-vulkan-drivers|libgl1-mesa-dri|libllvm[0-9]*|libvulkan1|libc6) ' "$folder/versions"
    exit 0
fi

program=$(command -v "$1") || {
    echo "newest.sh: there is no program $1" >&2
    exit 2
}
shift
loader=$(find_file '*/ld-linux*.so.*')
libc=$(find_file '*/libc.so.6')
libraries=$(dirname "$libc")
export LIBGL_DRIVERS_PATH="$libraries/dri"
export __EGL_VENDOR_LIBRARY_DIRS="$folder/root/usr/share/glvnd/egl_vendor.d"
VK_DRIVER_FILES=$(find_file '*/vulkan/icd.d/lvp_icd*.json')
export VK_DRIVER_FILES
export VK_ICD_FILENAMES="$VK_DRIVER_FILES" # what older loaders of Vulkan read
exec "$loader" --library-path "$libraries" "$program" "$@"
