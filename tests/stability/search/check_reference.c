// Compares the fast renderer with the reference.
//
// docs/picture.md allows the fast renderer to round positions, alpha and levels of detail a little
// differently. At a tie, such a difference moves a corner by 1/256 pixel, switches a sample of a
// clipped surface, or changes a number of probes. This judge therefore also draws the reference
// after tiny random changes of the scene, and keeps the range of values that each pixel takes. A
// pixel of the fast renderer is explained if it lies in this range or within a tolerance of it.
#include "tests/stability/search/check.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

// How often the scene is changed until a difference counts as unexplained, and after how many
// changes a difference in many pixels does.
enum { CHANGES_STEP = 8, CHANGES_IF_MANY = 24, MANY_PIXELS = 30, CHANGES_MOST = 96 };

// The range of values that the reference takes, in linear light.
typedef struct Range {
    size_t count; // values: 3 for each pixel
    double *low;
    double *high;
} Range;

// What tiny changes must restore: a copy of the meshes' positions, and the view.
typedef struct Original {
    float *positions[DIP_TEST_SCENE_PARTS];
    float cutoffs[DIP_TEST_SCENE_PARTS];
    DipPose pose;
} Original;

// --- tiny changes --------------------------------------------------------------------------------

static size_t size_of_positions(const DipMeshDef *mesh) {
    return 3 * (size_t)mesh->vertex_count * sizeof(float);
}

static void keep_original(const SearchScene *made, Original *original) {
    for (int m = 0; m < made->scene.def.mesh_count; m++) {
        const DipMeshDef *mesh = &made->scene.meshes[m];
        original->positions[m] = malloc(size_of_positions(mesh));
        if (original->positions[m]) {
            memcpy(original->positions[m], mesh->positions, size_of_positions(mesh));
        }
    }
    for (int m = 0; m < made->scene.def.material_count; m++) {
        original->cutoffs[m] = made->scene.materials[m].alpha_cutoff;
    }
    original->pose = made->scene.pose;
}

static void restore_original(SearchScene *made, const Original *original) {
    for (int m = 0; m < made->scene.def.mesh_count; m++) {
        const DipMeshDef *mesh = &made->scene.meshes[m];
        if (original->positions[m]) {
            memcpy((float *)(uintptr_t)mesh->positions, original->positions[m],
                   size_of_positions(mesh));
        }
    }
    for (int m = 0; m < made->scene.def.material_count; m++) {
        made->scene.materials[m].alpha_cutoff = original->cutoffs[m];
    }
    made->scene.pose = original->pose;
}

static void free_original(Original *original) {
    for (int m = 0; m < DIP_TEST_SCENE_PARTS; m++) {
        free(original->positions[m]);
    }
}

// Returns a random generator that depends only on a position, so that equal vertices move alike.
static Random random_of_vertex(const float *position, uint64_t seed) {
    Random random = {seed};
    for (int i = 0; i < 3; i++) {
        uint32_t bits;
        memcpy(&bits, &position[i], sizeof bits);
        random.state = random_u64(&random) ^ bits;
    }
    return random;
}

static double column_length(const float *m, int column) {
    const double x = (double)m[column], y = (double)m[4 + column], z = (double)m[8 + column];
    return sqrt(x * x + y * y + z * z);
}

// Returns true if the object keeps the origin (0, 0, 0), because its transform is nearly singular:
// a column lies within about 15 degrees of the plane of the other two.
static bool keeps_origin(const float *m) {
    double cross[3]; // of columns c + 1 and c + 2
    for (int c = 0; c < 3; c++) {
        double cross2 = 0.0;
        double volume = 0.0;
        for (int r = 0; r < 3; r++) {
            const int c1 = (c + 1) % 3, c2 = (c + 2) % 3;
            const int r1 = 4 * ((r + 1) % 3), r2 = 4 * ((r + 2) % 3);
            cross[r] =
                (double)m[r1 + c1] * (double)m[r2 + c2] - (double)m[r2 + c1] * (double)m[r1 + c2];
            cross2 += cross[r] * cross[r];
            volume += cross[r] * (double)m[4 * r + c];
        }
        if (!(sqrt(cross2) * column_length(m, c) <= 3.99 * fabs(volume))) {
            return true;
        }
    }
    return false;
}

// Returns a bound, in metres, for the distance between the eye and the origin from which the fast
// renderer transforms an object's vertices. It chooses origins 1024 units of the mesh apart, except
// for transforms that are nearly singular.
static double distance_from_origin(const SearchScene *made, const DipObjectDef *object) {
    const float *m = object->transform;
    double reach = 0.0;
    double eye = 0.0;
    for (int i = 0; i < 3; i++) {
        reach = fmax(reach, 1024.0 * column_length(m, i));
        eye = fmax(eye, fabs(made->scene.pose.position_world[i] - (double)m[4 * i + 3]));
    }
    return keeps_origin(m) ? 4.0 * eye : fmin(eye, reach);
}

// Moves the vertices of an object's mesh by as much as docs/picture.md allows floats to move them:
// in proportion to the distance from the eye, and to the eye's distance from the object's origin.
static void shake_mesh(SearchScene *made, const DipObjectDef *object, uint64_t seed) {
    const DipMeshDef *mesh = &made->scene.meshes[object->mesh];
    const float *m = object->transform;
    double scales[3];
    for (int i = 0; i < 3; i++) {
        scales[i] = column_length(m, i);
    }
    const double from_origin = distance_from_origin(made, object);
    float *positions = (float *)(uintptr_t)mesh->positions;
    for (uint32_t v = 0; v < mesh->vertex_count; v++) {
        double offset[3];
        search_vertex_from_eye(made, object, v, offset);
        const double distance =
            sqrt(offset[0] * offset[0] + offset[1] * offset[1] + offset[2] * offset[2]);
        const double most = 0x1p-22 * (distance + 2.0 * from_origin);
        Random random = random_of_vertex(positions + 3 * (size_t)v, seed);
        for (int i = 0; i < 3; i++) {
            const double move = scales[i] > 0.0 ? most / scales[i] : 0.0;
            positions[3 * v + (uint32_t)i] =
                (float)((double)positions[3 * v + (uint32_t)i] + random_real(&random, -move, move));
        }
    }
}

// Turns the camera and changes its field of view by at most 1/512 pixel, mostly by less.
static void shake_camera(SearchScene *made, Random *random) {
    DipPose *pose = &made->scene.pose;
    const double pixel_rad = 2.0 * tan(pose->fov_y_deg * 3.14159265358979 / 360.0) / made->height;
    const double most = fmin(pixel_rad, 0.1) / 512.0 * ldexp(1.0, -random_int(random, 0, 12));
    const double *q = pose->orientation;
    const double r[3] = {random_real(random, -most, most) / 2.0,
                         random_real(random, -most, most) / 2.0,
                         random_real(random, -most, most) / 2.0};
    const double turned[4] = {q[0] + q[3] * r[0] + q[1] * r[2] - q[2] * r[1],
                              q[1] + q[3] * r[1] + q[2] * r[0] - q[0] * r[2],
                              q[2] + q[3] * r[2] + q[0] * r[1] - q[1] * r[0],
                              q[3] - q[0] * r[0] - q[1] * r[1] - q[2] * r[2]};
    memcpy(pose->orientation, turned, sizeof turned);
    pose->fov_y_deg *= 1.0 + random_real(random, -most, most);
}

// Moves the camera by as much as the vertices of some object may move. Where floats are far from 0,
// this replaces the movement of vertices, which would need finer floats.
static void shift_camera(SearchScene *made, Random *random) {
    double most = 0.0;
    for (int i = 0; i < made->scene.def.object_count; i++) {
        most = fmax(most, 0x1p-21 * distance_from_origin(made, &made->scene.objects[i]));
    }
    most *= ldexp(1.0, -random_int(random, 0, 8));
    for (int i = 0; i < 3; i++) {
        made->scene.pose.position_world[i] += random_real(random, -most, most);
    }
}

// Changes the scene so little that the fast renderer may mistake the one for the other.
static void shake(SearchScene *made, uint64_t seed) {
    Random random = {seed};
    bool shaken[DIP_TEST_SCENE_PARTS] = {false};
    for (int i = 0; i < made->scene.def.object_count; i++) {
        const DipObjectDef *object = &made->scene.objects[i];
        if (!shaken[object->mesh]) {
            shaken[object->mesh] = true;
            shake_mesh(made, object, seed);
        }
    }
    for (int i = 0; i < made->scene.def.material_count; i++) {
        float *cutoff = &made->scene.materials[i].alpha_cutoff;
        *cutoff += *cutoff > 0.0f ? (float)random_real(&random, -0x1p-7, 0x1p-7) : 0.0f;
    }
    shake_camera(made, &random);
    shift_camera(made, &random);
}

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

// Greatest difference that rounding of texels, weights, light and 8 bits explains.
static double tolerance_of(const SearchScene *made) {
    const bool narrow = made->quality.step[DIP_SETTING_OPT] == DIP_OPT_ADVANCED;
    return narrow && made->quality.step[DIP_SETTING_MIPDEBUG] ? 0.021 : 0.012;
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
        for (size_t c = 0; c < 3; c++) {
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
    Original original = {0};
    keep_original(made, &original);
    for (int i = 0; left.pixels > 0 && !run->broken && i < CHANGES_MOST; i++) {
        shake(made, run->seed + (uint64_t)i);
        widen(run, made, range);
        restore_original(made, &original);
        if ((i + 1) % CHANGES_STEP == 0) {
            left = find_unexplained(range, picture, tolerance);
        }
        if (i + 1 >= CHANGES_IF_MANY && left.pixels >= MANY_PIXELS) {
            break;
        }
    }
    free_original(&original);
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
    if (!widen(run, made, range) || !judge(run, made, range, "reference", finding)) {
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
    Range range = {count, malloc(count * sizeof(double)), malloc(count * sizeof(double))};
    StabilityRun run = {.isa = dip_isa_best(), .pool = bench->pool_of_one, .seed = 1};
    bool good = range.low && range.high;
    for (size_t i = 0; good && i < count; i++) {
        range.low[i] = INFINITY;
        range.high[i] = -INFINITY;
    }
    good = good && judge_all(&run, &made, &range, finding);
    if (run.broken) {
        search_found(finding, "drawing", INFINITY, "%s", run.broken_why);
    } else if (!range.low || !range.high) {
        search_found(finding, "drawing", INFINITY, "out of memory");
    }
    free(range.low);
    free(range.high);
    dip_test_scene_free(&made.scene);
    return good;
}
