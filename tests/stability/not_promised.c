// What Diptych does not promise: the last section of docs/stability.md.
#include "tests/stability/document.h"

const char *const stability_not_promised =
    "## What is not promised\n"
    "\n"
    "- Floats that a scene stores far from the origin have already lost precision: at 1000 km, "
    "two\n"
    "  neighbouring floats are 6.25 cm apart. Diptych draws the stored values exactly.\n";
