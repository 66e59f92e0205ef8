#!/bin/sh
# Starts ./run in a copy of the tree with a fake cmake, and checks that it builds the tree itself when
# it is called through links, and that it starts a finished build of a tree that cannot be written.
#
# Usage: check_start.sh ROOT
set -eu
root=$(cd "$1" && pwd)
folder=$(cd -P "$(mktemp -d)" && pwd)
trap 'chmod -R u+w "$folder"; rm -rf "$folder"' EXIT
chmod 755 "$folder"
tree=$folder/tree
mkdir -p "$tree/.ci" "$tree/build/release" "$folder/bin" "$folder/elsewhere"
cp "$root/run" "$tree/"
cp "$root/.ci/prepare.sh" "$tree/.ci/"
# The fakes: all packages are installed, and a build prints its folder.
printf '#!/bin/sh\nprintf installed\n' >"$folder/bin/dpkg-query"
printf '#!/bin/sh\npwd >>"%s/built"\n' "$folder" >"$folder/bin/cmake"
printf '#!/bin/sh\necho "started in $(pwd -P): $*"\n' >"$tree/build/release/diptych"
touch "$tree/build/release/build.ninja"
chmod +x "$folder/bin/"* "$tree/build/release/diptych"
PATH=$folder/bin:$PATH
export PATH
failed=0

# expect COMMAND: must build $tree, stay in the caller's folder and hand its arguments over.
expect() {
    rm -f "$folder/built"
    cd "$folder/elsewhere"
    found=$("$1" one "two words" 2>&1) || true
    if [ "$found" != "started in $folder/elsewhere: one two words" ]; then
        echo "$1 printed: $found"
        failed=1
    fi
    if [ "$(sort -u "$folder/built" 2>/dev/null)" != "${2-$tree}" ]; then
        echo "$1 built: $(cat "$folder/built" 2>/dev/null), accepted: ${2-$tree}"
        failed=1
    fi
}

ln -s "$tree" "$folder/link"
ln -s "$tree/run" "$folder/bin/diptych"
expect "$tree/run"
expect "$folder/link/run"
expect "$folder/bin/diptych"

# ./test finds its tree in the same way.
if [ "$(grep '^cd ' "$root/run" | head -n 1)" != "$(grep '^cd ' "$root/test" | head -n 1)" ]; then
    echo "./run and ./test enter their tree in different ways"
    failed=1
fi

chmod -R a-w "$tree"
if [ "$(id -u)" = 0 ]; then # To root, all folders can be written.
    chmod 777 "$folder"
    cat >"$folder/as_user" <<TEXT
#!/bin/sh
exec setpriv --reuid=65534 --regid=65534 --clear-groups "$tree/run" "\$@"
TEXT
    chmod +x "$folder/as_user"
    expect "$folder/as_user" ""
else
    expect "$tree/run" ""
fi
exit $failed
