#!/bin/sh
# Compares Diptych's pictures of the models of make_models.py, and of a packed one, with those of
# three.js, and the PSNR with bars.txt. The exit code is 77 if a tool or the network is missing.
# Usage: beside_models.sh PYTHON DIPTYCH OUT
set -e
here=$(cd "$(dirname "$0")" && pwd)
python=$1 diptych=$2 out=$3
"$python" -c 'import numpy, PIL' || exit 77
for program in chromium node npm; do
    command -v "$program" >/dev/null || exit 77
done
rm -rf "$out/models" "$out/pictures"
mkdir -p "$out/pack"
"$python" "$here/make_models.py" "$out/models"

# node looks for packages beside the script.
cp "$here/../pack_gltf.mjs" "$out/pack/"
(cd "$out/pack" && npm install --no-fund --no-audit --prefix . \
    @gltf-transform/core@4.5.1 @gltf-transform/extensions@4.5.1 @gltf-transform/functions@4.5.1 \
    draco3dgltf@1.5.7 meshoptimizer@1.3.0 ktx2-encoder@0.6.0 sharp@0.35.5) || exit 77
node "$out/pack/pack_gltf.mjs" "$out/models/torus.glb" "$out/models/torus_" >/dev/null
rm "$out/models/torus_ktx2.glb" # Diptych refuses KTX2.
for way in draco meshopt quantized webp; do
    cp "$out/models/torus.pose" "$out/models/torus_$way.pose"
done

exec "$python" "$here/beside.py" "$diptych" "$out/models" "$out/pictures" --npm "$out" --scale 8 \
    --bars "$here/bars.txt"
