// What Diptych does not promise: the last section of docs/stability.md.
#include "tests/stability/document.h"

const char *const stability_not_promised =
    "## What is not promised\n"
    "\n"
    "- Floats that a scene stores far from the origin have already lost precision: at 1000 km, "
    "two\n"
    "  neighbouring floats are 6.25 cm apart. Diptych draws the stored values exactly.\n"
    "- Clipping computes in double precision. A triangle whose corners mix magnitudes by more than "
    "a\n"
    "  factor of about 1e14 may be cut in the wrong position.\n"
    "- Surfaces that lie in one plane but have different triangles show through each other, "
    "because\n"
    "  vertices are rounded to 1/256 pixel. Lift a decal as row N16 says, or give it the same "
    "vertices\n"
    "  as the surface.\n"
    "- Anisotropic filtering reads a whole number of probes, which can change on a whole surface "
    "at\n"
    "  once if the surface is nearly parallel to the picture. Row A63 bounds the change.\n"
    "- The rows about small motions sample poses, directions and settings. A pop at another "
    "moment is\n"
    "  possible.\n";
