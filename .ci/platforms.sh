# ./test platforms: builds renderer/, campaths/ and their tests for other platforms, and runs them
# in emulators. ./test sources this file.
#
# On every platform: the catalogue of hard cases with the hashes that docs/stability.md lists, and all
# pictures that have shipped hashes. On aarch64, whose emulator is slow, the catalogue runs in its
# short form, which has no hashes, and all unit tests of renderer/ and campaths/ that are not
# labelled slow run too.

PACKAGES_PLATFORMS="gcc-aarch64-linux-gnu libc6-dev-arm64-cross qemu-user musl-tools
    gcc-mingw-w64-x86-64-posix wine64 gcc-i686-linux-gnu libc6-dev-i386-cross"
PLATFORMS=${PLATFORMS:-musl i686 aarch64 windows}

# fetch_cmocka ARCHITECTURE: unpacks Debian's cmocka for another architecture into
# build/platforms/ARCHITECTURE, without changing the system's list of architectures.
fetch_cmocka() {
    root=$TOP/build/platforms/$1
    [ ! -f "$root/cmocka.pc" ] || return 0
    mkdir -p "$root/lists/partial" "$root/cache/archives/partial"
    foreign="-qq -o APT::Architectures::=amd64 -o APT::Architectures::=$1
        -o Dir::State::lists=$root/lists -o Dir::Cache=$root/cache"
    (
        cd "$root"
        apt-get $foreign update || true # the index of another architecture may suffice
        apt-get $foreign download "libcmocka0:$1" "libcmocka-dev:$1"
        for package in libcmocka*.deb; do
            dpkg-deb -x "$package" .
        done
        library=$(dirname "$(find "$PWD" -name 'libcmocka.so')")
        printf 'Name: cmocka\nDescription: cmocka\nVersion: 1.1.5\nLibs: -L%s -lcmocka -Wl,-rpath,%s\nCflags: -I%s\n' \
            "$library" "$library" "$PWD/usr/include" >cmocka.pc
    ) >"$root.log" 2>&1
}

# build_platform NAME TARGET [CMAKE OPTION]...
build_platform() {
    name=$1
    shift
    # A folder with nothing but stb: the other headers of /usr/include belong to this machine.
    mkdir -p build/platforms/headers
    ln -sfn /usr/include/stb build/platforms/headers/stb
    target=$1
    shift
    cmake -S . -B "build/platform-$name" -G Ninja --toolchain "$TOP/.ci/platforms/$name.cmake" \
        -DCMAKE_BUILD_TYPE=Release -DDIP_PROGRAM=OFF -DDIP_WERROR=ON -DDIP_ASSERTS=ON \
        -DSTB_DXT_INCLUDE_DIR="$TOP/build/platforms/headers" "$@" &&
        cmake --build "build/platform-$name" --target "$target"
}

# measure NAME DEPTH [OPTION]...: runs the catalogue's program on a platform.
measure() {
    measured=$1
    depth=$2
    shift 2
    emulate "$measured" \
        "build/platform-$measured/tests/stability/stability$([ "$measured" != windows ] || echo .exe)" \
        --depth "$depth" "$@"
}

# test_platform NAME: builds and runs the tests of a platform. The short form of the catalogue draws
# every seventh picture of row N48, so all pictures are drawn after it on aarch64.
test_platform() {
    case $1 in
    aarch64)
        fetch_cmocka arm64 && PKG_CONFIG_LIBDIR="$TOP/build/platforms/arm64" build_platform "$1" all \
                -DDIP_STABILITY_DEPTH=short &&
            ctest --test-dir "build/platform-$1" -LE 'long|slow' -j "$(nproc)" \
                --output-on-failure --no-tests=error &&
            measure "$1" full --row N48 --expect docs/stability.md
        ;;
    *)
        build_platform "$1" stability -DBUILD_TESTING=OFF &&
            measure "$1" full --expect docs/stability.md
        ;;
    esac
}

# emulate NAME PROGRAM [ARGUMENT]... A kernel that starts no 32-bit programs needs an emulator for i686.
emulate() {
    name=$1
    shift
    case $name in
    aarch64) qemu-aarch64 -L /usr/aarch64-linux-gnu "$@" ;;
    i686) "$@" || { [ $? = 126 ] && qemu-i386 "$@"; } ;;
    windows) WINEPREFIX="$TOP/build/platforms/wine" WINEDEBUG=-all /usr/lib/wine/wine64 "$@" ;;
    *) "$@" ;;
    esac
}

# Prints a line per platform; the output of a platform is in build/platform-NAME.log.
test_platforms() {
    mkdir -p build
    failed=
    for platform in $PLATFORMS; do
        begin=$(date +%s)
        if test_platform "$platform" >"build/platform-$platform.log" 2>&1; then
            result=passed
        else
            result=FAILED
            failed="$failed $platform"
        fi
        echo "$platform: $result in $(($(date +%s) - begin)) s" >&2
    done
    for platform in $failed; do
        echo "== $platform" >&2
        tail -40 "build/platform-$platform.log" >&2
    done
    [ -z "$failed" ]
}
