// Rows about footprints of textures that are extremely long or have no width.
#define DIP_LANES      1 // footprint_simd.h serves one instruction set at a time: here, scalar
#define DIP_ISA_SUFFIX scalar
#include "renderer/base/trig.h"
#include "renderer/pipeline/texture/footprint_simd.h"
#include "renderer/reference/internal/footprint.h"
#include "renderer/catalogue/random.h"
#include "renderer/catalogue/stability.h"

#include <math.h>

enum { LEVELS = 14, SIZE = 8192 };

static const double pi = 3.14159265358979323846;

// A footprint whose axes are known.
typedef struct Ellipse {
    double major; // length of the major axis, in texels
    double minor; // of the minor axis; may be 0
    double ddx[2];
    double ddy[2];
} Ellipse;

// Makes an ellipse. `direction` is the direction of its major axis in the texture; `roll` turns the
// screen.
static Ellipse make_ellipse(double major, double minor, double direction, double roll) {
    const double along[2] = {major * dip_cos(direction), major * dip_sin(direction)};
    const double across[2] = {-minor * dip_sin(direction), minor * dip_cos(direction)};
    Ellipse e = {.major = major, .minor = minor};
    for (int i = 0; i < 2; i++) {
        e.ddx[i] = along[i] * dip_cos(roll) - across[i] * dip_sin(roll);
        e.ddy[i] = along[i] * dip_sin(roll) + across[i] * dip_cos(roll);
    }
    return e;
}

// The level of detail and the number of probes in the finer level.
typedef struct Reading {
    double level;
    int probes;
} Reading;

static Reading read_fast(const Ellipse *e, int max_anisotropy, bool exact) {
    static DipTexture texture;
    texture.width = texture.height = SIZE;
    texture.level_count = LEVELS;
    const DipSampler sampler = {
        .texture = &texture, .max_anisotropy = max_anisotropy, .exact_footprint = exact};
    const Jacobian j = {vf_splat((float)e->ddx[0]), vf_splat((float)e->ddx[1]),
                        vf_splat((float)e->ddy[0]), vf_splat((float)e->ddy[1])};
    const Axis axis = anisotropic_axis(&sampler, j);
    const Vi level = find_level(&sampler, axis.minor2);
    const Vi probes = count_probes(&sampler, &axis, 0);
    return (Reading){level[0] / 256.0, probes[0]};
}

static Reading read_reference(const Ellipse *e, int max_anisotropy, bool exact) {
    const DipFootprint f = dip_reference_footprint(e->ddx, e->ddy, max_anisotropy, exact, 0);
    return (Reading){dip_reference_level(f.lambda, 0.0, 0, LEVELS - 1), f.probe_count};
}

typedef Reading Read(const Ellipse *e, int max_anisotropy, bool exact);

// Compares a reading with the closed form: lambda = log2(major / eta), where eta is the ratio of
// the axes but at most max_anisotropy.
static void check(StabilityRun *run, const Ellipse *e, int max, bool exact, Read *read,
                  const char *what) {
    const double eta = e->minor > 0.0 ? fmin(e->major / e->minor, max) : max;
    const double lambda = fmin(fmax(log2(e->major) - log2(eta), 0.0), LEVELS - 1.0);
    const double probes = fmin(eta, fmax(1.0, e->major)) - 1e-4;
    const Reading found = read(e, max, exact);
    if (read == read_fast) { // The reference computes with libm, whose last digits differ.
        stability_keep(run, (double[]){found.level, found.probes}, 2);
    }
    stability_error(run, found.level - lambda, "%s: level with axes %g and %g, af=%d", what,
                    e->major, e->minor, max);
    if (fabs(probes - rint(probes)) > 1e-3) {
        stability_expect(run, found.probes == (int)ceil(probes),
                         "%s: %d probes with axes %g and %g, af=%d", what, found.probes, e->major,
                         e->minor, max);
    }
}

static void check_everywhere(StabilityRun *run, const Ellipse *rolled, const Ellipse *straight,
                             int max) {
    check(run, rolled, max, true, read_fast, "fast path, aaf=on");
    check(run, rolled, max, true, read_reference, "reference, aaf=on");
    // Along the screen's axes, plain AF finds the exact axes, too.
    check(run, straight, max, false, read_fast, "fast path, aaf=off");
    check(run, straight, max, false, read_reference, "reference, aaf=off");
}

// Coordinates that are constant along one direction of the screen have a minor axis of 0.
static void measure_singular(StabilityRun *run) {
    Random random = {run->seed};
    const int count = stability_count(run, 1000, 100000, 5000000);
    for (int i = 0; i < count; i++) {
        const double major = random_magnitude(&random, -40, 19);
        const double direction = random_real(&random, 0.0, pi);
        const Ellipse rolled =
            make_ellipse(major, 0.0, direction, random_real(&random, 0.0, 2.0 * pi));
        const Ellipse straight = make_ellipse(major, 0.0, direction, 0.0);
        check_everywhere(run, &rolled, &straight, 2 << i % 4);
    }
}

static void measure_long(StabilityRun *run) {
    Random random = {run->seed};
    const int count = stability_count(run, 1000, 100000, 5000000);
    for (int i = 0; i < count; i++) {
        const double major = random_magnitude(&random, -10, 19);
        const double minor = major * random_magnitude(&random, -100, -6);
        const double direction = random_real(&random, 0.0, pi);
        const Ellipse rolled =
            make_ellipse(major, minor, direction, random_real(&random, 0.0, 2.0 * pi));
        const Ellipse straight = make_ellipse(major, minor, direction, 0.0);
        check_everywhere(run, &rolled, &straight, 2 << i % 4);
    }
}

static const StabilityRow rows[] = {
    {.id = "N24",
     .promise = "Where the texture coordinates are collinear on the screen, the level of detail "
                "and the number of probes are finite and right.",
     .truth = "the closed form for an ellipse without width",
     .unit = "levels",
     .bound = 0.0025,
     .measure = measure_singular},
    {.id = "N25",
     .promise =
         "A footprint that is up to 2^100 times as long as wide takes at most as many probes "
         "as the setting af says, from the right level.",
     .truth = "the closed form for an ellipse with known axes",
     .unit = "levels",
     .bound = 0.0025,
     .measure = measure_long},
};

const StabilityTopic stability_footprint = {"footprint", "Extreme footprints", rows,
                                            sizeof rows / sizeof *rows};
