#!/bin/sh
# Fails when a function of renderer/simd/ is not called in tests/renderer/simd/calls_simd.c, where
# test_simd calls all of them.
#
# Usage: check_calls.sh ROOT
set -eu
cd "$1"
# Parts of functions, which only some instruction sets have.
parts="vec_load_quad vec_load_four vf_interleave vf_join_halves srgb_curve"
functions=$(sed -n 's/^VEC_INLINE [A-Za-z0-9_ ]* \**\([a-z0-9_]*\)(.*/\1/p' renderer/simd/*.h)
[ "$(echo "$functions" | wc -l)" -ge 80 ] || {
    echo "fewer than 80 functions in renderer/simd/; has the way changed in which they are written?"
    exit 1
}
failed=0
for function in $functions; do
    case " $parts " in *" $function "*) continue ;; esac
    if ! grep -q "\b$function(" tests/renderer/simd/calls_simd.c; then
        echo "tests/renderer/simd/calls_simd.c does not call $function"
        failed=1
    fi
done
exit $failed
