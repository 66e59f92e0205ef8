# Installs packages and builds. ./run and ./test source this file from the repository's top folder.

TOP=$PWD
PACKAGES_RUN="gcc cmake ninja-build pkg-config libsdl2-dev libx11-dev libfreetype-dev libfontconfig-dev
    fonts-dejavu-core libinih-dev libstb-dev libassimp-dev libcjson-dev
    libmeshoptimizer-dev libdraco-dev g++ libwebp-dev" # The last line: packed models and pictures.
PACKAGES_TEST="$PACKAGES_RUN git doxygen clang clang-format libcmocka-dev lld xvfb xauth xdotool imagemagick
    python3 python3-cffi python3-numpy dpkg-dev"
# The cost report's page; one machine that acts as several.
PACKAGES_LONG="chromium chromium-driver python3-selenium python3-pil poppler-utils parallel munge slurm-wlm"
PACKAGES_LINT="clang-tidy cppcheck"
PACKAGES_SANITIZERS="clang libclang-rt-dev llvm" # llvm: names of functions in the findings

is_installed() {
    [ "$(dpkg-query -W -f '${db:Status-Status}' "$1" 2>/dev/null)" = installed ]
}

# require_packages NAME...: installs the packages that are missing. Prints the command first.
require_packages() {
    if ! command -v dpkg-query >/dev/null || ! command -v apt-get >/dev/null; then
        [ -d "$TOP/build/release" ] || cat >&2 <<TEXT
This system has no apt-get. Diptych needs the following packages (Debian names):
    $*
Install the corresponding packages of your system. The build continues and reports what is missing.
TEXT
        return 0
    fi
    missing=
    for package in "$@"; do
        is_installed "$package" || missing="$missing $package"
    done
    [ -n "$missing" ] || return 0
    as_root=
    if [ "$(id -u)" != 0 ]; then
        if ! command -v sudo >/dev/null; then
            echo "Packages are missing. Install them as root: apt-get install$missing" >&2
            return 1
        fi
        as_root=sudo
    fi
    install="$as_root apt-get install -y --no-install-recommends$missing"
    echo "Installing missing packages: $install" >&2
    $as_root apt-get update -qq >&2 || true
    DEBIAN_FRONTEND=noninteractive $install >&2
}

# shown_if_it_fails PRESET COMMAND...: appends the command's output to the build's log.
shown_if_it_fails() {
    log="$TOP/build/$1.log"
    shift
    if ! (cd "$TOP" && "$@") >>"$log" 2>&1; then
        cat "$log" >&2
        echo "The build failed. Its output is also in $log" >&2
        return 1
    fi
}

configured= # the preset that was configured last

# configure PRESET: does nothing if this preset was the last that was configured.
configure() {
    [ "${configured:-}" != "$1" ] || return 0
    mkdir -p "$TOP/build"
    if [ ! -f "$TOP/build/$1/build.ninja" ]; then
        echo "Configuring and building ($1). The first time takes about a minute ..." >&2
    fi
    : >"$TOP/build/$1.log"
    shown_if_it_fails "$1" cmake --preset "$1" || return 1
    configured=$1
}

# build PRESET [TARGET]: configures and builds. Shows the build's output only if it fails.
build() {
    configure "$1" && shown_if_it_fails "$1" cmake --build --preset "$1" ${2:+--target "$2"}
}
