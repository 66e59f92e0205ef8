// Tests of scene packs: a pack gives back the scene that was written, and no damage to a pack makes
// the reader crash or accept something that points outside.
#include "assets/pack/scene_pack.h"
#include "assets/pack/scene_pack_layout.h"
#include "renderer/base/error.h"
#include "renderer/scene/motion.h"
#include "tests/assets/fixture.h"
#include "tests/assets/same_scene.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#include <cmocka.h>

enum { MUTATIONS = 20000, MOST_CHANGES = 4 };

// Writes a pack to a temporary file and returns its bytes. The caller frees them.
static uint8_t *pack_bytes(const DipScenePack *pack, size_t *size_bytes) {
    FILE *file = tmpfile();
    assert_non_null(file);
    assert_true(dip_scene_pack_note(fileno(file), DIP_IMPORT_READS, 0));
    assert_true(dip_scene_pack_write(fileno(file), pack));
    const off_t end = lseek(fileno(file), 0, SEEK_END);
    assert_true(end > 0);
    *size_bytes = (size_t)end;
    uint8_t *bytes = malloc(*size_bytes);
    assert_non_null(bytes);
    assert_int_equal(pread(fileno(file), bytes, *size_bytes, 0), end);
    fclose(file);
    return bytes;
}

static DipModel *load(const char *name) {
    const char *path = fixture_data(name);
    DipError err = {0};
    DipModel *model = dip_model_load_with_normals(&path, 1, NULL, NULL, &err);
    if (!model) {
        fail_msg("%s: %s", name, err.message);
    }
    return model;
}

// Cuts off the padding after the last section, the text, so that every byte beyond a text lies
// outside of the pack.
static void trim(uint8_t *bytes, size_t *size_bytes) {
    PackHeader header;
    memcpy(&header, bytes, sizeof header);
    assert_true(header.text.offset >= header.failures.offset);
    header.total_bytes = header.text.offset + header.text.count;
    *size_bytes = (size_t)header.total_bytes;
    memcpy(bytes, &header, sizeof header);
}

// Returns the pack of a model that has every kind of record and array.
static uint8_t *full_pack(size_t *size_bytes) {
    DipModel *model = load("seam.gltf");
    static const DipLightDef lights[] = {
        {.name = "sun", .colour_lin = {1, 2, 3}, .direction_world = {0, -1, 0}},
        {.name = "bulb",
         .kind = DIP_LIGHT_POINT,
         .colour_lin = {1, 1, 1},
         .position_world = {1, 2, 3},
         .attenuation = {0, 0, 1},
         .range_m = 5},
        {.name = "cone",
         .kind = DIP_LIGHT_SPOT,
         .colour_lin = {1, 1, 1},
         .position_world = {1, 2, 3},
         .direction_world = {1, 0, 0},
         .attenuation = {1, 0, 0},
         .inner_deg = 10,
         .outer_deg = 20}};
    const DipLightingDef lighting = {.ambient_lin = {0.2f, 0.3f, 0.4f},
                                     .sky_lin = {0.1f, 0.2f, 0.3f},
                                     .lights = lights,
                                     .light_count = 3,
                                     .shading = DIP_SHADING_GOURAUD};
    DipScenePack pack = {.scene = *dip_model_scene_def(model)};
    pack.scene.lighting = &lighting;
    DipError warning;
    dip_error_set(&warning, DIP_ERROR_UNSUPPORTED, "seam.gltf", 0, "key", "a warning");
    warning.severity = DIP_SEVERITY_WARNING;
    dip_error_list_add(&pack.warnings, &warning);
    uint8_t *bytes = pack_bytes(&pack, size_bytes);
    trim(bytes, size_bytes);
    dip_error_list_free(&pack.warnings);
    dip_model_destroy(&model);
    return bytes;
}

static void a_pack_gives_back_the_scene(void **state) {
    (void)state;
    static const char *const names[] = {"seam.gltf", "tags.gltf", "instances.gltf", "square.ply",
                                        "lights.gltf"};
    for (size_t i = 0; i < sizeof names / sizeof names[0]; ++i) {
        DipModel *model = load(names[i]);
        const DipScenePack written = {.scene = *dip_model_scene_def(model)};
        size_t size_bytes;
        uint8_t *bytes = pack_bytes(&written, &size_bytes);
        DipScenePack read;
        DipError err = {0};
        if (!dip_scene_pack_read(bytes, size_bytes, &read, &err)) {
            fail_msg("%s: %s", names[i], err.message);
        }
        assert_same_scene(&written.scene, &read.scene);
        assert_int_equal(read.failure.code, DIP_ERROR_NONE);
        dip_scene_pack_free(&read);
        free(bytes);
        dip_model_destroy(&model);
    }
}

// Returns a pack with a warning and a failure. The caller frees the list of warnings.
static DipScenePack failed_pack(void) {
    DipScenePack pack = {0};
    DipError warning;
    dip_error_set(&warning, DIP_ERROR_UNSUPPORTED, "a.obj", 0, "wall", "two\nlines");
    warning.severity = DIP_SEVERITY_WARNING;
    dip_error_list_add(&pack.warnings, &warning);
    dip_error_set(&pack.failure, DIP_ERROR_RANGE, "a.obj", 7, "roof", "too large");
    return pack;
}

static void a_pack_gives_back_the_failure_and_the_warnings(void **state) {
    (void)state;
    DipScenePack written = failed_pack();
    size_t size_bytes;
    uint8_t *bytes = pack_bytes(&written, &size_bytes);
    DipScenePack read;
    assert_true(dip_scene_pack_read(bytes, size_bytes, &read, NULL));
    assert_int_equal(read.failure.code, DIP_ERROR_RANGE);
    assert_int_equal(read.failure.line, 7);
    assert_string_equal(read.failure.file, "a.obj");
    assert_string_equal(read.failure.key, "roof");
    assert_string_equal(read.failure.message, "too large");
    assert_int_equal(read.warnings.count, 1);
    assert_string_equal(read.warnings.items[0].message, "two lines");
    dip_scene_pack_free(&read);
    dip_error_list_free(&written.warnings);
    free(bytes);
}

// A note is believed if the header is one of this version and its numbers are in range.
static void notes_are_read_back(void **state) {
    (void)state;
    FILE *file = tmpfile();
    assert_non_null(file);
    DipImportStage stage;
    int index;
    assert_false(dip_scene_pack_read_note(fileno(file), &stage, &index)); // The file is empty.
    assert_true(dip_scene_pack_note(fileno(file), DIP_IMPORT_PICTURES, DIP_MAX_MODEL_FILES - 1));
    assert_true(dip_scene_pack_read_note(fileno(file), &stage, &index));
    assert_int_equal(stage, DIP_IMPORT_PICTURES);
    assert_int_equal(index, DIP_MAX_MODEL_FILES - 1);
    const struct {
        size_t field;
        uint32_t value;
        bool ok;
    } cases[] = {
        {offsetof(PackHeader, stage), DIP_IMPORT_DONE, true},
        {offsetof(PackHeader, stage), DIP_IMPORT_DONE + 1, false},
        {offsetof(PackHeader, file_index), DIP_MAX_MODEL_FILES, false},
        {offsetof(PackHeader, version), PACK_VERSION + 1, false},
        {offsetof(PackHeader, version), PACK_VERSION - 1, false},
        {offsetof(PackHeader, header_bytes), sizeof(PackHeader) - 8, false},
        {offsetof(PackHeader, magic), 0, false},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
        uint32_t kept;
        const off_t at = (off_t)cases[i].field;
        assert_int_equal(pread(fileno(file), &kept, 4, at), 4);
        assert_int_equal(pwrite(fileno(file), &cases[i].value, 4, at), 4);
        if (dip_scene_pack_read_note(fileno(file), &stage, &index) != cases[i].ok) {
            fail_msg("case %zu", i);
        }
        assert_int_equal(pwrite(fileno(file), &kept, 4, at), 4);
    }
    fclose(file);
}

// Poses a scene at some moments, if it moves, and reads all of it at each.
static void read_motion(const DipSceneDef *scene) {
    if (!scene->motion) {
        return;
    }
    DipPosedDef *posed = dip_posed_def_create(scene, NULL);
    for (int i = 0; posed && i < 3; ++i) {
        dip_posed_def_set_share(posed, i * 0.4);
        read_whole_scene(dip_posed_def(posed));
    }
    dip_posed_def_destroy(&posed);
}

// Reads a copy of exactly this size, so that a memory checker notices every read outside of it.
static bool read_copy(const uint8_t *bytes, size_t size_bytes) {
    uint8_t *copy = malloc(size_bytes + (size_bytes == 0));
    assert_non_null(copy);
    memcpy(copy, bytes, size_bytes);
    DipScenePack pack;
    DipError err = {0};
    const bool accepted = dip_scene_pack_read(copy, size_bytes, &pack, &err);
    if (accepted) {
        read_whole_scene(&pack.scene);
        read_motion(&pack.scene);
    } else {
        assert_true(err.code == DIP_ERROR_FORMAT || err.code == DIP_ERROR_MEMORY);
        assert_non_null(strstr(err.message, "the importer's result is malformed"));
    }
    dip_scene_pack_free(&pack);
    free(copy);
    return accepted;
}

static void every_truncated_pack_is_refused(void **state) {
    (void)state;
    size_t size_bytes;
    uint8_t *bytes = full_pack(&size_bytes);
    assert_true(read_copy(bytes, size_bytes));
    for (size_t size = 0; size < size_bytes; ++size) {
        assert_false(read_copy(bytes, size));
    }
    free(bytes);
}

static void a_lengthened_pack_is_refused(void **state) {
    (void)state;
    size_t size_bytes;
    uint8_t *bytes = full_pack(&size_bytes);
    uint8_t *longer = calloc(1, size_bytes + 64);
    assert_non_null(longer);
    memcpy(longer, bytes, size_bytes);
    assert_false(read_copy(longer, size_bytes + 64));
    free(longer);
    free(bytes);
}

static void a_text_without_an_end_is_refused(void **state) {
    (void)state;
    size_t size_bytes;
    uint8_t *bytes = full_pack(&size_bytes);
    bytes[size_bytes - 1] = 'x';
    assert_false(read_copy(bytes, size_bytes));
    free(bytes);
}

static bool accepts_textures(const DipTextureDef *textures, int count, bool share_texels) {
    const DipScenePack pack = {
        .scene = {.textures = textures, .texture_count = count, .near_m = 1.0f}};
    size_t size_bytes;
    uint8_t *bytes = pack_bytes(&pack, &size_bytes);
    if (share_texels) {
        PackHeader header;
        PackTexture records[2];
        memcpy(&header, bytes, sizeof header);
        memcpy(records, bytes + header.textures.offset, sizeof records);
        records[1].rgba8 = records[0].rgba8;
        memcpy(bytes + header.textures.offset, records, sizeof records);
    }
    const bool accepted = read_copy(bytes, size_bytes);
    free(bytes);
    return accepted;
}

static void textures_have_at_most_8192_texels_in_a_direction(void **state) {
    (void)state;
    static const uint8_t texels[4 * 8193];
    const int sizes[][2] = {{8192, 1}, {1, 8192}, {8193, 1}, {1, 8193}};
    for (int i = 0; i < 4; ++i) {
        const DipTextureDef texture = {
            .name = "", .width = sizes[i][0], .height = sizes[i][1], .rgba8 = texels};
        assert_int_equal(accepts_textures(&texture, 1, false), i < 2);
    }
}

// If many records named the same large array, a small pack could take a long time to read.
static void arrays_do_not_overlap(void **state) {
    (void)state;
    static const uint8_t texels[4];
    const DipTextureDef texture = {.name = "", .width = 1, .height = 1, .rgba8 = texels};
    const DipTextureDef two[] = {texture, texture};
    assert_true(accepts_textures(two, 2, false));
    assert_false(accepts_textures(two, 2, true));
}

// --- motion --------------------------------------------------------------------------------------

// Returns the pack of a model with a rig, skins, tracks, moving objects and moving meshes.
static uint8_t *motion_pack(size_t *size_bytes) {
    const DipModelOptions options = {.animation = DIP_MODEL_ANIMATION_FIRST};
    DipModel *model = fixture_load(fixture_data("motion.gltf"), &options, NULL);
    const DipScenePack pack = {.scene = *dip_model_scene_def(model)};
    uint8_t *bytes = pack_bytes(&pack, size_bytes);
    dip_model_destroy(&model);
    return bytes;
}

static void a_pack_gives_back_the_motion(void **state) {
    (void)state;
    size_t size_bytes;
    uint8_t *bytes = motion_pack(&size_bytes);
    const DipModelOptions options = {.animation = DIP_MODEL_ANIMATION_FIRST};
    DipModel *model = fixture_load(fixture_data("motion.gltf"), &options, NULL);
    DipScenePack read;
    DipError err = {0};
    if (!dip_scene_pack_read(bytes, size_bytes, &read, &err)) {
        fail_msg("%s", err.message);
    }
    const DipSceneDef *def = dip_model_scene_def(model);
    assert_same_scene(def, &read.scene);
    const DipMotionDef *a = def->motion, *b = read.scene.motion;
    assert_int_equal(a->rig_count, 1);
    assert_int_equal(b->rig_count, 1);
    const DipMotionRig *x = &a->rigs[0], *y = &b->rigs[0];
    assert_string_equal(x->clip, y->clip);
    assert_int_equal(x->rig.node_count, y->rig.node_count);
    assert_int_equal(x->skin_count, y->skin_count);
    assert_int_equal(x->track_count, y->track_count);
    for (int i = 0; i < x->track_count; ++i) {
        const DipTrack *m = &x->tracks[i], *n = &y->tracks[i];
        assert_true(m->target == n->target && m->interpolation == n->interpolation);
        assert_true(m->node == n->node && m->key_count == n->key_count);
        assert_memory_equal(m->times, n->times, m->key_count * sizeof *m->times);
        assert_memory_equal(m->values, n->values, dip_track_value_count(m) * sizeof *m->values);
    }
    for (int i = 0; i < x->skin_count; ++i) {
        const DipRigSkin *m = &x->skins[i], *n = &y->skins[i];
        assert_int_equal(m->joint_count, n->joint_count);
        assert_memory_equal(m->nodes, n->nodes, (size_t)m->joint_count * sizeof *m->nodes);
        assert_memory_equal(m->inverse_binds, n->inverse_binds,
                            12 * (size_t)m->joint_count * sizeof *m->inverse_binds);
    }
    dip_scene_pack_free(&read);
    dip_model_destroy(&model);
    free(bytes);
}

// A number of 32 bits that replaces a field of a record.
typedef struct MotionFault {
    size_t section; // where the header has the section
    size_t field;   // where the record has the field
    uint32_t value;
    const char *reason;
} MotionFault;

static void assert_fault(uint8_t *bytes, size_t size_bytes, size_t at, uint32_t value,
                         const char *reason) {
    uint32_t kept;
    DipScenePack pack;
    DipError err = {0};
    memcpy(&kept, bytes + at, sizeof kept);
    memcpy(bytes + at, &value, sizeof value);
    if (dip_scene_pack_read(bytes, size_bytes, &pack, &err) || !strstr(err.message, reason)) {
        fail_msg("\"%s\", expected %s", err.message, reason);
    }
    dip_scene_pack_free(&pack);
    memcpy(bytes + at, &kept, sizeof kept);
}

// Each field has a number that is wrong by itself. The numbers of arrays are too large for the pack
// where they are as large as is accepted, which gives another reason.
static void wrong_records_of_motion_are_named(void **state) {
    (void)state;
    enum { MOST = PACK_MAX_RECORDS };
#define SECTION(name) offsetof(PackHeader, name)
    static const MotionFault faults[] = {
        {SECTION(rigs), offsetof(PackRig, node_count), MOST, "counts of a rig (item 0)"},
        {SECTION(rigs), offsetof(PackRig, skin_count), MOST, "counts of a rig (item 0)"},
        {SECTION(rigs), offsetof(PackRig, track_count), MOST, "counts of a rig (item 0)"},
        {SECTION(rigs), offsetof(PackRig, weight_count), MOST + 1, "counts of a rig (item 0)"},
        {SECTION(rigs), offsetof(PackRig, weight_count), MOST, ": a rig (item 0)"},
        {SECTION(rigs), offsetof(PackRig, rest_weights), 0, ": a rig (item 0)"},
        {SECTION(rigs), offsetof(PackRig, is_held), 2, ": a rig (item 0)"},
        {SECTION(rigs), offsetof(PackRig, clip), MOST, ": a rig (item 0)"},
        {SECTION(nodes), offsetof(PackNode, has_matrix), 2, "a node (item 0)"},
        {SECTION(skins), offsetof(PackSkin, joint_count), MOST + 1, "a skin (item 0)"},
        {SECTION(skins), offsetof(PackSkin, nodes), 0, "a skin (item 0)"},
        {SECTION(skins), offsetof(PackSkin, inverse_binds), 0, "a skin (item 0)"},
        {SECTION(tracks), offsetof(PackTrack, target), DIP_TRACK_WEIGHTS + 1,
         "kind of a track (item 0)"},
        {SECTION(tracks), offsetof(PackTrack, interpolation), DIP_INTERPOLATION_CUBICSPLINE + 1,
         "kind of a track (item 0)"},
        {SECTION(tracks), offsetof(PackTrack, width), UINT32_MAX, "kind of a track (item 0)"},
        {SECTION(tracks), offsetof(PackTrack, width), MOST + 1, "kind of a track (item 0)"},
        {SECTION(tracks), offsetof(PackTrack, width), MOST, ": a track (item 0)"},
        {SECTION(tracks), offsetof(PackTrack, key_count), 0, "kind of a track (item 0)"},
        {SECTION(tracks), offsetof(PackTrack, times), 0, ": a track (item 0)"},
        {SECTION(tracks), offsetof(PackTrack, values), 0, ": a track (item 0)"},
        {SECTION(moving_meshes), offsetof(PackMovingMesh, shape_count), 0,
         "shapes of a moving mesh (item 0)"},
        {SECTION(moving_meshes), offsetof(PackMovingMesh, shape_count), MOST + 1,
         "shapes of a moving mesh (item 0)"},
        {SECTION(moving_meshes), offsetof(PackMovingMesh, shape_count), MOST,
         ": a moving mesh (item 0)"},
        {SECTION(moving_meshes), offsetof(PackMovingMesh, positions), 0,
         ": a moving mesh (item 0)"},
    };
#undef SECTION
    size_t size_bytes;
    uint8_t *bytes = motion_pack(&size_bytes);
    for (size_t i = 0; i < sizeof faults / sizeof *faults; ++i) {
        PackSection section;
        memcpy(&section, bytes + faults[i].section, sizeof section);
        assert_true(section.count > 0);
        assert_fault(bytes, size_bytes, section.offset + faults[i].field, faults[i].value,
                     faults[i].reason);
    }
    PackHeader header; // One rig more would need another rig's nodes.
    PackRig rig;
    memcpy(&header, bytes, sizeof header);
    memcpy(&rig, bytes + header.rigs.offset, sizeof rig);
    assert_fault(bytes, size_bytes, header.rigs.offset + offsetof(PackRig, node_count),
                 rig.node_count + 1, "counts of a rig (item 0)");
    assert_fault(bytes, size_bytes, header.rigs.offset + offsetof(PackRig, skin_count),
                 rig.skin_count + 1, "counts of a rig (item 0)");
    assert_fault(bytes, size_bytes, header.rigs.offset + offsetof(PackRig, track_count),
                 rig.track_count + 1, "counts of a rig (item 0)");
    assert_fault(bytes, size_bytes, offsetof(PackHeader, rigs.count), 0, "motion without rigs");
    assert_true(read_copy(bytes, size_bytes));
    free(bytes);
}

// A pack has one failure. Here, the warning and the failure pass for two failures.
static void several_failures_are_refused(void **state) {
    (void)state;
    DipScenePack written = failed_pack();
    size_t size_bytes;
    uint8_t *bytes = pack_bytes(&written, &size_bytes);
    PackHeader header;
    memcpy(&header, bytes, sizeof header);
    assert_fault(bytes, size_bytes, offsetof(PackHeader, failures.count), UINT32_MAX,
                 "section failures");
    header.failures = (PackSection){.offset = header.warnings.offset, .count = 2};
    header.warnings.count = 0;
    memcpy(bytes, &header, sizeof header);
    assert_fault(bytes, size_bytes, offsetof(PackHeader, failures.count), 2, "several failures");
    dip_error_list_free(&written.warnings);
    free(bytes);
}

// --- damage --------------------------------------------------------------------------------------

// Collects numbers that sit on boundaries: of types, of limits, of this pack and of its sections.
static int boundary_numbers(const uint8_t *bytes, size_t size_bytes, uint64_t *numbers) {
    static const uint64_t general[] = {0,
                                       1,
                                       2,
                                       3,
                                       64,
                                       8192,
                                       8193,
                                       0x7fffffff,
                                       0x80000000,
                                       0xffffffff,
                                       0x7f800000,
                                       0x7fc00000,
                                       0xff800000,
                                       UINT64_MAX,
                                       UINT64_MAX / 2,
                                       0x7ff0000000000000,
                                       0x7ff8000000000000,
                                       0x7fe0000000000000}; // doubles
    PackHeader header;
    memcpy(&header, bytes, sizeof header);
    const uint64_t own[] = {size_bytes,          header.text.count,     header.text.offset,
                            header.meshes.count, header.textures.count, header.meshes.offset};
    int count = 0;
    for (size_t i = 0; i < sizeof general / sizeof general[0]; ++i) {
        numbers[count++] = general[i];
    }
    for (size_t i = 0; i < sizeof own / sizeof own[0]; ++i) {
        numbers[count++] = own[i] - 1;
        numbers[count++] = own[i];
        numbers[count++] = own[i] + 1;
    }
    return count;
}

enum { MOST_NUMBERS = 64 };

// Puts every boundary number at every place of the pack, and frees it.
static void try_wrong_numbers(uint8_t *bytes, size_t size_bytes) {
    uint64_t numbers[MOST_NUMBERS];
    const int count = boundary_numbers(bytes, size_bytes, numbers);
    int refused = 0;
    for (size_t at = 0; at + 8 <= size_bytes; at += 4) {
        for (int i = 0; i < 2 * count; ++i) {
            uint8_t kept[8];
            memcpy(kept, bytes + at, 8);
            memcpy(bytes + at, &numbers[i / 2], i % 2 ? 8 : 4);
            refused += !read_copy(bytes, size_bytes);
            memcpy(bytes + at, kept, 8);
        }
    }
    assert_true(refused > 1000);
    assert_true(read_copy(bytes, size_bytes));
    free(bytes);
}

static void no_wrong_number_is_believed(void **state) {
    (void)state;
    size_t size_bytes;
    uint8_t *bytes = full_pack(&size_bytes);
    try_wrong_numbers(bytes, size_bytes);
    bytes = motion_pack(&size_bytes);
    try_wrong_numbers(bytes, size_bytes);
}

// xorshift64*, so that every machine tries the same changes.
static uint64_t next_random(uint64_t *state) {
    *state ^= *state >> 12;
    *state ^= *state << 25;
    *state ^= *state >> 27;
    return *state * 2685821657736338717u;
}

// Changes one bit, or replaces one number by a boundary number.
static void mutate(uint8_t *bytes, size_t size_bytes, const uint64_t *numbers, int number_count,
                   uint64_t *random) {
    const size_t at = (size_t)(next_random(random) % (size_bytes - 8)) / 4 * 4;
    const uint64_t kind = next_random(random) % 3;
    if (kind == 0) {
        bytes[at + next_random(random) % 4] ^= (uint8_t)(1u << (next_random(random) % 8));
    } else {
        const uint64_t number = numbers[next_random(random) % (uint64_t)number_count];
        memcpy(bytes + at, &number, kind == 1 ? 4 : 8);
    }
}

static void no_damaged_pack_is_read_beyond_its_end(void **state) {
    (void)state;
    size_t size_bytes;
    uint8_t *bytes = full_pack(&size_bytes);
    uint8_t *damaged = malloc(size_bytes);
    assert_non_null(damaged);
    uint64_t numbers[MOST_NUMBERS];
    const int count = boundary_numbers(bytes, size_bytes, numbers);
    uint64_t random = 20240607;
    int refused = 0;
    for (int i = 0; i < MUTATIONS; ++i) {
        memcpy(damaged, bytes, size_bytes);
        const uint64_t changes = 1 + next_random(&random) % MOST_CHANGES;
        for (uint64_t c = 0; c < changes; ++c) {
            mutate(damaged, size_bytes, numbers, count, &random);
        }
        refused += !read_copy(damaged, size_bytes);
    }
    // Changes of texels, positions and padding are no damage.
    assert_in_range(refused, MUTATIONS / 4, MUTATIONS - 1);
    free(damaged);
    free(bytes);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_pack_gives_back_the_scene),
        cmocka_unit_test(a_pack_gives_back_the_failure_and_the_warnings),
        cmocka_unit_test(notes_are_read_back),
        cmocka_unit_test(every_truncated_pack_is_refused),
        cmocka_unit_test(a_lengthened_pack_is_refused),
        cmocka_unit_test(a_text_without_an_end_is_refused),
        cmocka_unit_test(textures_have_at_most_8192_texels_in_a_direction),
        cmocka_unit_test(arrays_do_not_overlap),
        cmocka_unit_test(a_pack_gives_back_the_motion),
        cmocka_unit_test(wrong_records_of_motion_are_named),
        cmocka_unit_test(several_failures_are_refused),
        cmocka_unit_test(no_wrong_number_is_believed),
        cmocka_unit_test(no_damaged_pack_is_read_beyond_its_end),
    };
    return cmocka_run_group_tests_name("scene packs", tests, NULL, NULL);
}
