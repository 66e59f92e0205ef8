// Reads the cameras of glTF files and samples their animations (cameras.h).
#include "assets/gltf/reader.h"
#include "assets/cameras.h"
#include "renderer/base/fp_mode.h"
#include "renderer/base/trig.h"

#include <cjson/cJSON.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

static const double keys_per_s = 120.0;     // A multiple of 24, 30, 40 and 60 frames per second.
static const double still_period_s = 1.0;   // Period of a path with a single key.
static const double max_duration_s = 3.6e9; // The most keys, at the greatest period of a path.
static const double max_position_m = 1e9;

enum { MAX_KEYS = 1000000, MAX_CAMERAS = 10000, MIN_PERIOD_NS = 1000 };

// The name of a camera, and a number such that all smaller ones, from 2 on, were taken when they
// were tried to make this name another one.
typedef struct Name {
    const char *text;
    int number;
} Name;

struct DipModelCameras {
    DipAnimatedModel *model; // Owns all texts and keys.
    DipModelCamera *items;
    Name *names; // Those of the items in alphabetical order, while a file is read.
    int count;
};

// A camera while its paths are made.
typedef struct Source {
    DipGltfReader *reader;
    DipModelCameras *cameras;
    DipUpAxis up;
    int node; // Index of a node of the model.
    const char *name;
    double fov_y_deg;
    double aspect;
    DipAnimationPlan chain; // The tracks of one animation that move the node or those above it.
} Source;

// --- poses ---------------------------------------------------------------------------------------

static double dot3(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static bool normalise3(double v[3]) {
    const double length = sqrt(dot3(v, v));
    for (int i = 0; i < 3; ++i) {
        v[i] /= length;
    }
    return isfinite(length) && length > 1e-30;
}

// Makes the unit quaternion of a rotation (rows), from whichever component is not small.
static void quaternion_of(double m[3][3], double q[4]) {
    const double trace = m[0][0] + m[1][1] + m[2][2];
    if (trace > 0.0) {
        const double s = 2.0 * sqrt(trace + 1.0);
        q[0] = (m[2][1] - m[1][2]) / s;
        q[1] = (m[0][2] - m[2][0]) / s;
        q[2] = (m[1][0] - m[0][1]) / s;
        q[3] = 0.25 * s;
        return;
    }
    const int i = m[1][1] > m[0][0] ? (m[2][2] > m[1][1] ? 2 : 1) : (m[2][2] > m[0][0] ? 2 : 0);
    const int j = (i + 1) % 3;
    const int k = (i + 2) % 3;
    const double s = 2.0 * sqrt(1.0 + m[i][i] - m[j][j] - m[k][k]);
    q[i] = 0.25 * s;
    q[j] = (m[j][i] + m[i][j]) / s;
    q[k] = (m[k][i] + m[i][k]) / s;
    q[3] = (m[k][j] - m[j][k]) / s;
}

// Reads position and orientation out of a transform (rows of a 3x4 matrix). The camera looks along
// the transform's -Z; +Y is up as far as it is perpendicular to that. Scales and mirrors are left
// out. Returns false if the transform flattens the camera or is not finite.
static bool key_of(const double world[12], double key[7]) {
    double y[3];
    double z[3];
    for (int row = 0; row < 3; ++row) {
        key[row] = world[4 * row + 3];
        y[row] = world[4 * row + 1];
        z[row] = world[4 * row + 2];
        if (!(fabs(key[row]) <= max_position_m)) {
            return false;
        }
    }
    if (!normalise3(y) || !normalise3(z)) {
        return false;
    }
    const double along = dot3(y, z);
    for (int i = 0; i < 3; ++i) {
        y[i] -= along * z[i];
    }
    if (!(dot3(y, y) > 1e-20) || !normalise3(y)) {
        return false;
    }
    double rotation[3][3];
    for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3;
        const int k = (i + 2) % 3;
        rotation[i][0] = y[j] * z[k] - y[k] * z[j];
        rotation[i][1] = y[i];
        rotation[i][2] = z[i];
    }
    quaternion_of(rotation, key + 3);
    return true;
}

// Turns a transform so that +Y is up, as up_axis.c turns the model.
static void turn_up(DipUpAxis up, double world[12]) {
    for (int column = 0; up == DIP_UP_z && column < 4; ++column) {
        const double y = world[4 + column];
        world[4 + column] = world[8 + column];
        world[8 + column] = -y;
    }
}

// Returns the time of a key of the tracks that differs from time_s by rounding only, or time_s.
// Without this, a STEP key between two roundings of one time would come a sample too late.
static double snap(const DipAnimationPlan *chain, double time_s) {
    const double tolerance = 1e-6 + 1e-7 * time_s;
    for (int i = 0; i < chain->track_count; ++i) {
        const DipTrack *track = &chain->tracks[i];
        uint32_t low = 0;
        uint32_t high = track->key_count;
        while (high - low > 1) { // times[low] <= time_s + tolerance, unless low is 0
            const uint32_t middle = low + (high - low) / 2;
            if (track->times[middle] <= time_s + tolerance) {
                low = middle;
            } else {
                high = middle;
            }
        }
        if (fabs(track->times[low] - time_s) <= tolerance) {
            return track->times[low];
        }
    }
    return time_s;
}

// --- paths ---------------------------------------------------------------------------------------

static void skip(const Source *source, const char *why) {
    dip_model_warn(source->reader->model->store, source->reader->model->path, source->name,
                   "the camera is skipped, because %s", why);
}

static double duration_of(const DipAnimationPlan *chain) {
    double duration_s = 0.0;
    for (int i = 0; i < chain->track_count; ++i) {
        const DipTrack *track = &chain->tracks[i];
        duration_s = fmax(duration_s, (double)track->times[track->key_count - 1]);
    }
    return duration_s;
}

// Divides the duration into equal steps. Returns their number, which is 0 for a still camera.
static size_t divide(double duration_s, int64_t *period_ns) {
    if (!(duration_s * 1e9 >= MIN_PERIOD_NS)) {
        *period_ns = (int64_t)(still_period_s * 1e9);
        return 0;
    }
    const double wanted = fmax(ceil(duration_s * keys_per_s - 1e-3), 1.0);
    const double steps = fmin(wanted, MAX_KEYS - 1);
    *period_ns = (int64_t)(duration_s * 1e9 / steps + 0.5);
    return (size_t)steps;
}

// Fills in the keys. Sets *ok to false if a key has no orientation.
static bool sample_keys(const Source *source, DipModelCamera *camera, bool *ok) {
    DipGltfReader *reader = source->reader;
    const double duration_s = duration_of(&source->chain);
    *ok = duration_s <= max_duration_s;
    if (!*ok) {
        skip(source, "its animation lasts too long, accepted up to 3.6e9 s");
        return true;
    }
    const size_t steps = divide(duration_s, &camera->period_ns);
    camera->key_count = steps + 1;
    double(*keys)[7] = dip_gltf_alloc(reader, camera->key_count, sizeof *keys);
    if (!keys) {
        return dip_gltf_no_room(reader);
    }
    const DipRig rig = dip_animated_rig(reader->model);
    for (size_t i = 0; *ok && i <= steps; ++i) {
        double world[12];
        const double time_s = steps > 0 ? duration_s * (double)i / (double)steps : duration_s;
        dip_rig_place_node(&rig, source->chain.tracks, source->chain.track_count, source->node,
                           snap(&source->chain, time_s), world);
        turn_up(source->up, world);
        *ok = key_of(world, keys[i]);
    }
    camera->keys = (const double(*)[7])keys;
    if (!*ok) {
        skip(source, "its transform is too large, flat, or not finite");
    }
    return true;
}

// Returns the index of a name, or of the first one after it.
static int place_of(const DipModelCameras *cameras, const char *name) {
    int low = 0, high = cameras->count;
    while (low < high) {
        const int middle = (low + high) / 2;
        if (strcmp(cameras->names[middle].text, name) < 0) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    return low;
}

// Returns the entry of a name, or NULL if no camera has this name.
static Name *find_name(const DipModelCameras *cameras, const char *name) {
    const int place = place_of(cameras, name);
    const bool found = place < cameras->count && strcmp(cameras->names[place].text, name) == 0;
    return found ? &cameras->names[place] : NULL;
}

// Makes a name that no other camera has: a number follows a name that is taken. Files with
// thousands of cameras of one name are read in time, since numbers that were taken are not tried
// again.
static const char *free_name(const Source *source, const char *animation) {
    char name[256];
    const int length = snprintf(name, 240, "%s%s%s", source->name, animation ? "/" : "",
                                animation ? animation : "");
    const size_t end = length < 240 ? (size_t)length : 239;
    Name *taken = find_name(source->cameras, name);
    while (taken) {
        snprintf(name + end, sizeof name - end, " %d", taken->number);
        if (!find_name(source->cameras, name)) {
            break;
        }
        ++taken->number;
    }
    return dip_animated_text(source->reader->model, name, sizeof name);
}

// Adds a camera and its name. Returns false when memory runs out.
static bool add_camera(DipModelCameras *cameras, const DipModelCamera *camera) {
    DipModelCamera *items = dip_array_grow(cameras->items, cameras->count, sizeof *items);
    cameras->items = items ? items : cameras->items;
    Name *names = dip_array_grow(cameras->names, cameras->count, sizeof *names);
    cameras->names = names ? names : cameras->names;
    if (items && names) {
        const int place = place_of(cameras, camera->name);
        memmove(names + place + 1, names + place, (size_t)(cameras->count - place) * sizeof *names);
        names[place] = (Name){camera->name, 2};
        items[cameras->count++] = *camera;
    }
    return items && names;
}

// Adds the path that the source's tracks make. animation: its name, or NULL.
static bool add_path(const Source *source, const char *animation) {
    DipModelCameras *cameras = source->cameras;
    if (cameras->count == MAX_CAMERAS) {
        return dip_gltf_refuse(&source->reader->gltf, DIP_ERROR_RANGE, "cameras",
                               "the file has more than %d camera paths", MAX_CAMERAS);
    }
    DipModelCamera camera = {.name = free_name(source, animation),
                             .fov_y_deg = source->fov_y_deg,
                             .aspect = source->aspect};
    bool ok;
    if (!camera.name) {
        return dip_gltf_no_room(source->reader);
    }
    if (!sample_keys(source, &camera, &ok)) {
        return false;
    }
    return !ok || add_camera(cameras, &camera) ||
           dip_model_out_of_memory(source->reader->gltf.err, source->reader->gltf.path);
}

static bool is_above(const DipAnimatedModel *model, int ancestor, int node) {
    while (node > ancestor) { // A node comes after its parent; DIP_NO_NODE is below all indices.
        node = model->nodes[node].parent;
    }
    return node == ancestor;
}

// Collects the tracks of an animation that move the camera.
static bool find_chain(Source *source, int animation) {
    DipGltfReader *reader = source->reader;
    const DipAnimationPlan *plan = &reader->model->animation_plans[animation];
    DipTrack *tracks = dip_gltf_alloc(reader, (size_t)plan->track_count, sizeof *tracks);
    source->chain = (DipAnimationPlan){.tracks = tracks};
    for (int i = 0; tracks && i < plan->track_count; ++i) {
        const DipTrack *track = &plan->tracks[i];
        if (track->target != DIP_TRACK_WEIGHTS &&
            is_above(reader->model, track->node, source->node)) {
            tracks[source->chain.track_count++] = *track;
        }
    }
    return tracks || dip_gltf_no_room(reader);
}

// Counts the animations that move the camera.
static bool count_moves(Source *source, int *count) {
    *count = 0;
    for (int a = 0; a < source->reader->model->def.animation_count; ++a) {
        if (!find_chain(source, a)) {
            return false;
        }
        *count += source->chain.track_count > 0;
    }
    return true;
}

static bool add_paths(Source *source) {
    const DipAnimatedModel *model = source->reader->model;
    int moves;
    if (!count_moves(source, &moves)) {
        return false;
    }
    if (moves == 0) {
        source->chain = (DipAnimationPlan){.track_count = 0};
        return add_path(source, NULL);
    }
    for (int a = 0; a < model->def.animation_count; ++a) {
        if (!find_chain(source, a) ||
            (source->chain.track_count > 0 &&
             !add_path(source, moves > 1 ? model->animations[a].name : NULL))) {
            return false;
        }
    }
    return true;
}

// --- the file ------------------------------------------------------------------------------------

static double number_of(const cJSON *object, const char *name) {
    const cJSON *item = cJSON_GetObjectItemCaseSensitive(object, name);
    return cJSON_IsNumber(item) && isfinite(item->valuedouble) ? item->valuedouble : 0.0;
}

// Reads the lens. Returns false after a warning if Diptych cannot draw what the camera sees.
static bool read_lens(Source *source, const cJSON *camera) {
    const cJSON *type = cJSON_GetObjectItemCaseSensitive(camera, "type");
    const cJSON *lens = cJSON_GetObjectItemCaseSensitive(camera, "perspective");
    if (cJSON_IsString(type) && strcmp(type->valuestring, "orthographic") == 0) {
        skip(source, "it is orthographic, accepted perspective cameras");
        return false;
    }
    source->fov_y_deg = number_of(lens, "yfov") * 180.0 / DIP_PI;
    source->aspect = fmax(number_of(lens, "aspectRatio"), 0.0);
    if (!(source->fov_y_deg >= 1.0 && source->fov_y_deg <= 170.0)) {
        skip(source, "it has no field of view (yfov) of 1 to 170 degrees");
        return false;
    }
    return true;
}

static bool read_camera(DipModelCameras *cameras, DipGltfReader *reader, int node, DipUpAxis up) {
    const cJSON *json = dip_gltf_item(&reader->gltf, DIP_GLTF_nodes, node);
    int index;
    if (!dip_gltf_integer(&reader->gltf, json, "camera", -1, &index)) {
        return false;
    }
    if (index < 0) {
        return true;
    }
    const cJSON *camera = dip_gltf_item(&reader->gltf, DIP_GLTF_cameras, index);
    if (!camera) {
        return false;
    }
    const cJSON *own = cJSON_GetObjectItemCaseSensitive(json, "name");
    const bool named = cJSON_IsString(own) && own->valuestring[0];
    Source source = {.reader = reader,
                     .cameras = cameras,
                     .up = up,
                     .node = reader->node_of[node],
                     .name = dip_gltf_name(reader, named ? json : camera, "camera", index)};
    if (!source.name) {
        return dip_gltf_no_room(reader);
    }
    return !read_lens(&source, camera) || add_paths(&source);
}

static bool read_cameras(DipModelCameras *cameras, DipGltfReader *reader, DipUpAxis up,
                         DipError *err) {
    if (!dip_gltf_open(&reader->gltf, reader->model->path, err)) {
        return false;
    }
    if (reader->gltf.tables[DIP_GLTF_cameras].count == 0) {
        return true;
    }
    if (!dip_gltf_check_extensions(&reader->gltf, NULL)) { // The model's load repeats its warnings.
        return false;
    }
    bool ok = dip_gltf_read_transforms(reader) && dip_gltf_read_animations(reader);
    for (int i = 0; ok && i < reader->gltf.tables[DIP_GLTF_nodes].count; ++i) {
        ok = read_camera(cameras, reader, i, up);
    }
    return ok;
}

static bool is_gltf(const char *path) {
    const char *dot = strrchr(path, '.');
    return dot && (strcasecmp(dot, ".gltf") == 0 || strcasecmp(dot, ".glb") == 0);
}

// Looks for the word "cameras" in the JSON, so that files without cameras cost no second parse.
// Returns true if the file cannot be read, because the reader then explains why.
static bool may_have_cameras(const char *path) {
    static const char word[] = "\"cameras\"";
    enum { KEPT = sizeof word - 2, BLOCK = 65536 };
    static const size_t glb_header_bytes = 20;
    uint8_t block[KEPT + BLOCK];
    FILE *file = fopen(path, "rb");
    if (!file) {
        return true;
    }
    size_t left = SIZE_MAX;
    size_t kept = fread(block, 1, glb_header_bytes, file);
    if (kept == glb_header_bytes && memcmp(block, "glTF", 4) == 0) {
        left = dip_gltf_u32(block + 12);
        kept = 0;
    }
    bool found = false;
    for (size_t count = 1; !found && count > 0 && left > 0;) {
        const size_t room = sizeof block - kept < left ? sizeof block - kept : left;
        count = fread(block + kept, 1, room, file);
        left -= count;
        const size_t size = kept + count;
        for (size_t i = 0; !found && i + sizeof word - 1 <= size; ++i) {
            found = block[i] == '"' && memcmp(block + i, word, sizeof word - 1) == 0;
        }
        kept = size < KEPT ? size : KEPT;
        memmove(block, block + size - kept, kept);
    }
    const bool broken = ferror(file) != 0;
    fclose(file);
    return found || broken;
}

DipModelCameras *dip_model_cameras_load(const char *file, DipUpAxis up, DipErrorList *warnings,
                                        DipError *err) {
    DIP_FP_MODE_SCOPE();
    DipModelCameras *cameras = calloc(1, sizeof *cameras);
    DipAnimatedModel *model = cameras ? dip_animated_model_make(file) : NULL;
    if (!model) {
        free(cameras);
        dip_model_out_of_memory(err, file);
        return NULL;
    }
    cameras->model = model;
    if (!is_gltf(file) || !may_have_cameras(file)) {
        return cameras;
    }
    DipGltfReader reader = {.model = model};
    DipError failure = {0};
    model->store->warnings = warnings;
    const bool ok = read_cameras(cameras, &reader, up, &failure);
    free(cameras->names);
    cameras->names = NULL;
    dip_gltf_close(&reader.gltf);
    model->store->warnings = NULL;
    if (!ok) {
        if (err) {
            *err = failure;
        }
        dip_model_cameras_destroy(&cameras);
    }
    return cameras;
}

void dip_model_cameras_destroy(DipModelCameras **cameras) {
    if (*cameras) {
        free((*cameras)->items);
        dip_animated_model_destroy(&(*cameras)->model);
        free(*cameras);
        *cameras = NULL;
    }
}

const DipModelCamera *dip_model_cameras_list(const DipModelCameras *cameras, int *count) {
    *count = cameras->count;
    return cameras->items;
}
