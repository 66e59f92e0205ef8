#!/bin/sh
# Installs a build by the documented command. The files move after they are installed: nothing in
# them may name the folder. The other tests of this folder use the copy.
#
# Usage: check_installing.sh SOURCE_DIR BUILD_DIR COPY_DIR
set -eu
source=$1 build=$2 to=$3
. "$source/tests/install/installed.sh"

command=$(documented install.md 'cmake --install')
grep -qF "$(tail -1 "$folder/documented")" "$source/README.md" ||
    fail "README.md installs by another command than docs/install.md"
without_the_rest
run_quietly "the build cannot be installed" sh -c "$command"
rm -rf "$to"
mv "$prefix" "$to"
