// Compares the fast renderer with the reference.
//
// docs/picture.md allows the fast renderer to round positions, alpha and levels of detail a little
// differently. At a tie, such a difference moves a corner by 1/256 pixel, switches a sample of a
// clipped surface, or changes a number of probes. This judge therefore also draws the reference
// after tiny random changes of the scene, and keeps the range of values that each pixel takes. A
// pixel of the fast renderer is explained if it lies in this range or within a tolerance of it.
// Pixels where blended surfaces overlap, in which no order is promised, are not judged
// (overlaps.h).
#include "tests/stability/search/overlaps.h"
#include "tests/stability/search/shake.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

// How often the scene is changed until a difference counts as unexplained, and after how many
// changes the differences are counted again. With 96 changes, some orders of surfaces that lie in
// one plane close to the eye were not drawn.
enum { CHANGES_STEP = 8, CHANGES_MOST = 384 };

// The range of values that the reference takes, in linear light.
typedef struct Range {
    size_t count; // values: 3 for each pixel
    double *low;
    double *high;
    bool *ignored; // of each pixel
} Range;

// --- the judge -----------------------------------------------------------------------------------

// Draws with the reference and widens the range by its picture.
static bool widen(StabilityRun *run, const SearchScene *made, Range *range) {
    const StabilityShot shot = search_scene_shot(made);
    StabilityPicture picture;
    if (!stability_draw_reference(run, &shot, &picture)) {
        return false;
    }
    for (size_t i = 0; i < range->count; i++) {
        const double value = picture.rgb_lin[i];
        if (!isfinite(value)) {
            stability_break(run, "pixel %zu of the reference is not finite", i / 3);
        }
        range->low[i] = fmin(range->low[i], value);
        range->high[i] = fmax(range->high[i], value);
    }
    stability_picture_free(&picture);
    return !run->broken;
}

static bool has_sky(const SearchScene *made) {
    for (int i = 0; i < made->scene.def.material_count; i++) {
        if (made->scene.materials[i].surface == DIP_SURFACE_SKY) {
            return true;
        }
    }
    return false;
}

// Returns the greatest difference that rounding of texels, weights, light and 8 bits explains. The
// narrow blend multiplies errors of the level of detail by 4. The clouds of a sky have steep edges,
// which rounded texels displace.
static double tolerance_of(const SearchScene *made) {
    const bool narrow = made->quality.step[DIP_SETTING_OPT] == DIP_OPT_ADVANCED;
    if (narrow && made->quality.step[DIP_SETTING_MIPDEBUG]) {
        return 0.021;
    }
    return has_sky(made) ? 0.02 : 0.012;
}

typedef struct Unexplained {
    size_t pixels;
    size_t worst_pixel;
    double worst; // greatest distance from the range
    double rms;   // of the distances from the range, over the whole picture
} Unexplained;

// Returns true if tiny changes of the scene change the reference's pixel.
static bool is_unstable(const Range *range, size_t pixel, double tolerance) {
    for (size_t i = 3 * pixel; i < 3 * pixel + 3; i++) {
        if (range->high[i] - range->low[i] > tolerance) {
            return true;
        }
    }
    return false;
}

// Finds the range of a channel of a pixel. It includes the ranges of the unstable pixels around the
// pixel: where tiny changes make an edge swing, the changes that were drawn may have missed the one
// that covers this pixel.
static void range_around(const Range *range, const StabilityPicture *picture, size_t pixel,
                         size_t channel, double tolerance, double *low, double *high) {
    enum { REACH = 2 };
    const int x = (int)(pixel % (size_t)picture->width);
    const int y = (int)(pixel / (size_t)picture->width);
    *low = range->low[3 * pixel + channel];
    *high = range->high[3 * pixel + channel];
    for (int j = y - REACH; j <= y + REACH; j++) {
        for (int i = x - REACH; i <= x + REACH; i++) {
            const bool inside = i >= 0 && j >= 0 && i < picture->width && j < picture->height;
            const size_t other = inside ? (size_t)j * (size_t)picture->width + (size_t)i : pixel;
            if (is_unstable(range, other, tolerance)) {
                *low = fmin(*low, range->low[3 * other + channel]);
                *high = fmax(*high, range->high[3 * other + channel]);
            }
        }
    }
}

static Unexplained find_unexplained(const Range *range, const StabilityPicture *picture,
                                    double tolerance) {
    Unexplained result = {0};
    for (size_t p = 0; p < range->count / 3; p++) {
        double outside = 0.0;
        for (size_t c = 0; c < 3 && !range->ignored[p]; c++) {
            const double value = picture->rgb_lin[3 * p + c];
            double low = range->low[3 * p + c];
            double high = range->high[3 * p + c];
            if (value < low - tolerance || value > high + tolerance) {
                range_around(range, picture, p, c, tolerance, &low, &high);
                // The changes that were drawn may also have missed the extremes.
                const double margin = is_unstable(range, p, tolerance) ? (high - low) / 4.0 : 0.0;
                low -= margin;
                high += margin;
            }
            outside = fmax(outside, fmax(low - value, value - high));
        }
        result.rms += outside * outside;
        result.pixels += outside > tolerance;
        if (outside > result.worst) {
            result.worst = outside;
            result.worst_pixel = p;
        }
    }
    result.rms = sqrt(result.rms / ((double)range->count / 3.0));
    return result;
}

static void report(const SearchScene *made, const Range *range, const StabilityPicture *picture,
                   const Unexplained *left, const char *check, SearchFinding *finding) {
    const size_t p = left->worst_pixel;
    const double *low = range->low + 3 * p;
    const double *high = range->high + 3 * p;
    const double *got = picture->rgb_lin + 3 * p;
    search_found(finding, check, left->rms,
                 "%zu pixels cannot be explained, RMS %.4f; worst at (%zu, %zu): the reference has "
                 "(%.4f..%.4f, %.4f..%.4f, %.4f..%.4f), the fast renderer (%.4f, %.4f, %.4f)",
                 left->pixels, left->rms, p % (size_t)made->width, p / (size_t)made->width, low[0],
                 high[0], low[1], high[1], low[2], high[2], got[0], got[1], got[2]);
}

// Widens the range by changes of the scene until it explains the picture or the changes run out.
static bool explain(StabilityRun *run, SearchScene *made, const StabilityPicture *picture,
                    Range *range, const char *check, SearchFinding *finding) {
    const double tolerance = tolerance_of(made);
    Unexplained left = find_unexplained(range, picture, tolerance);
    SearchOriginal original = {0};
    search_keep_original(made, &original);
    for (int i = 0; left.pixels > 0 && !run->broken && i < CHANGES_MOST; i++) {
        search_shake(made, run->seed + (uint64_t)i);
        widen(run, made, range);
        search_restore_original(made, &original);
        if ((i + 1) % CHANGES_STEP == 0) {
            left = find_unexplained(range, picture, tolerance);
        }
    }
    search_free_original(&original);
    if (left.pixels > 0 && !run->broken) {
        report(made, range, picture, &left, check, finding);
    }
    return left.pixels == 0 && !run->broken;
}

// --- pictures that the reference judges ----------------------------------------------------------

// Returns true if neither the near plane nor the guard band cuts any triangle. Cutting starts at a
// triangle's first corner, so a cut triangle may change a little when its corners are rotated.
static bool nothing_is_cut(const SearchScene *made) {
    for (int i = 0; i < made->scene.def.object_count; i++) {
        const DipObjectDef *object = &made->scene.objects[i];
        const DipMeshDef *mesh = &made->scene.meshes[object->mesh];
        for (uint32_t v = 0; v < mesh->vertex_count; v++) {
            double offset[3];
            search_vertex_from_eye(made, object, v, offset);
            const double depth = search_depth(made, offset);
            const double reach = fabs(offset[0]) + fabs(offset[1]) + fabs(offset[2]);
            if (depth < 1.001 * (double)made->scene.def.near_m || reach > 32.0 * depth) {
                return false;
            }
        }
    }
    return made->scene.reflection.width == 0;
}

static void rotate_corners(SearchScene *made) {
    for (int m = 0; m < made->scene.def.mesh_count; m++) {
        uint32_t *indices = (uint32_t *)(uintptr_t)made->scene.meshes[m].indices;
        for (uint32_t i = 0; i + 2 < made->scene.meshes[m].index_count; i += 3) {
            const uint32_t first = indices[i];
            indices[i] = indices[i + 1];
            indices[i + 1] = indices[i + 2];
            indices[i + 2] = first;
        }
    }
}

static bool judge(StabilityRun *run, SearchScene *made, Range *range, const char *check,
                  SearchFinding *finding) {
    const StabilityShot shot = search_scene_shot(made);
    StabilityPicture picture;
    if (!stability_draw(run, &shot, &picture)) {
        return false;
    }
    const bool explained = explain(run, made, &picture, range, check, finding);
    stability_picture_free(&picture);
    return explained;
}

static bool judge_all(StabilityRun *run, SearchScene *made, Range *range, SearchFinding *finding) {
    if (!widen(run, made, range)) {
        return false;
    }
    if (search_is_beyond_precision(made)) {
        return true;
    }
    if (!judge(run, made, range, "reference", finding)) {
        return false;
    }
    if (nothing_is_cut(made)) {
        rotate_corners(made);
        return judge(run, made, range, "rotated corners", finding);
    }
    return true;
}

bool search_check_reference(const SearchBench *bench, Choices *choices, SearchFinding *finding) {
    static SearchScene made;
    choices_rewind(choices);
    search_scene_make(&made, choices);
    const size_t count = 3 * (size_t)made.width * (size_t)made.height;
    Range range = {count, malloc(count * sizeof(double)), malloc(count * sizeof(double)),
                   calloc(count / 3, sizeof(bool))};
    StabilityRun run = {.isa = dip_isa_best(), .pool = bench->pool_of_one, .seed = 1};
    bool good = range.low && range.high && range.ignored &&
                search_find_overlaps(&run, choices, range.ignored);
    for (size_t i = 0; good && i < count; i++) {
        range.low[i] = INFINITY;
        range.high[i] = -INFINITY;
    }
    good = good && judge_all(&run, &made, &range, finding);
    if (run.broken) {
        search_found(finding, "drawing", INFINITY, "%s", run.broken_why);
    } else if (!range.low || !range.high || !range.ignored) {
        search_found(finding, "drawing", INFINITY, "out of memory");
    }
    free(range.low);
    free(range.high);
    free(range.ignored);
    dip_test_scene_free(&made.scene);
    return good;
}
