// Tests what loading models and pictures does when memory runs out: a model is loaded whole or not
// at all, in this process and through the importer. This program is also its own importer.
#include "assets/animation.h"
#include "assets/cameras.h"
#include "assets/importer.h"
#include "assets/pack/scene_pack.h"
#include "tests/assets/fixture.h"
#include "tests/assets/same_scene.h"
#include "tests/support/out_of_memory.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#include <cmocka.h>

static const char importer_word[] = "import";

// --- models --------------------------------------------------------------------------------------

typedef struct Loading {
    const char *file;
    DipModelOptions options;
    DipModel *model;
    DipModel *expected;
    size_t expected_warnings;
    DipErrorList warnings;
} Loading;

static bool load(void *context, DipError *err) {
    Loading *l = context;
    l->model = dip_model_load_with(&l->file, 1, &l->options, NULL, &l->warnings, err);
    return l->model != NULL;
}

static void check_model(void *context, bool succeeded) {
    const Loading *l = context;
    assert_int_equal(l->model != NULL, succeeded);
    if (succeeded) {
        assert_same_scene(dip_model_scene_def(l->expected), dip_model_scene_def(l->model));
    }
}

static void free_model(void *context) {
    Loading *l = context;
    dip_model_destroy(&l->model);
    dip_error_list_free(&l->warnings);
}

static const char crab[] = DIP_ASSETS_DIR "/gallery/crab.md2"; // its key frames play

static void check_loading(const char *how, const char *file, const DipImporter *importer,
                          int short_count) {
    char title[FIXTURE_PATH];
    Loading l = {.file = file,
                 .options = {.normal_maps = true,
                             .importer = importer,
                             .animation = DIP_MODEL_ANIMATION_FIRST}};
    l.expected = dip_model_load_with(&l.file, 1, &l.options, NULL, NULL, NULL);
    assert_non_null(l.expected);
    snprintf(title, sizeof title, "%s %s", how, file);
    dip_out_of_memory_check(&(DipOutOfMemory){.name = title,
                                              .context = &l,
                                              .run = load,
                                              .check = check_model,
                                              .finish = free_model,
                                              .short_count = short_count});
    dip_model_destroy(&l.expected);
}

static void model_is_loaded_whole_or_not_at_all(void **state) {
    (void)state;
    static const char *const names[] = {"square.gltf", "seam.gltf",      "square.obj",
                                        "tags.gltf",   "instances.gltf", "lights.gltf",
                                        "motion.gltf", "references.x"};
    for (size_t i = 0; i < sizeof names / sizeof *names; ++i) {
        check_loading("loading", fixture_data(names[i]), NULL, 40);
    }
    check_loading("loading", crab, NULL, 40);
}

static void model_is_imported_whole_or_not_at_all(void **state) {
    (void)state;
    const DipImporter importer = {.program = "/proc/self/exe", .command = importer_word};
    check_loading("importing", fixture_data("square.gltf"), &importer, 0);
    check_loading("importing", fixture_data("lights.gltf"), &importer, 0);
    check_loading("importing", fixture_data("motion.gltf"), &importer, 0);
    check_loading("importing", crab, &importer, 40);
}

// --- pictures ------------------------------------------------------------------------------------

typedef struct Picturing {
    const char *file;
    const DipImporter *importer;
    DipPicture picture;
    DipPicture other;
} Picturing;

static bool import_picture(void *context, DipError *err) {
    Picturing *p = context;
    return dip_picture_import(p->file, p->importer, &p->picture, err);
}

static bool combine(void *context, DipError *err) {
    Picturing *p = context;
    DipPicture made;
    if (!dip_picture_with_opacity(&p->other, &p->other, &made)) {
        return dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, NULL, "out of memory");
    }
    p->picture = made;
    return true;
}

static bool copy_bgra(void *context, DipError *err) {
    Picturing *p = context;
    return dip_picture_from_bgra(p->other.rgba8, 2, 2, "name", &p->picture, err);
}

static void check_picture(void *context, bool succeeded) {
    const Picturing *p = context;
    assert_int_equal(p->picture.rgba8 != NULL, succeeded);
}

static void free_picture(void *context) {
    dip_picture_free(&((Picturing *)context)->picture);
}

static void picture_is_read_whole_or_not_at_all(void **state) {
    (void)state;
    const DipImporter importer = {.program = "/proc/self/exe", .command = importer_word};
    fixture_write("picture.png", fixture_png, sizeof fixture_png);
    char file[FIXTURE_PATH];
    snprintf(file, sizeof file, "%s", fixture_path("picture.png"));
    Picturing p = {.file = file};
    assert_true(dip_picture_read_file(file, &p.other, NULL));
    DipOutOfMemory operation = {.name = "reading a picture",
                                .context = &p,
                                .run = import_picture,
                                .check = check_picture,
                                .finish = free_picture,
                                .needs_every_allocation = true};
    dip_out_of_memory_check(&operation);
    static const char *const formats[] = {"bc1.dds", "palette.pcx", "text.ppm", "light.hdr"};
    for (size_t i = 0; i < sizeof formats / sizeof *formats; ++i) {
        char data_name[64];
        snprintf(data_name, sizeof data_name, "pictures/%s", formats[i]);
        operation.name = formats[i];
        p.file = fixture_data(data_name);
        dip_out_of_memory_check(&operation);
    }
    p.file = file;
    operation.name = "importing a picture";
    p.importer = &importer;
    operation.needs_every_allocation = false;
    dip_out_of_memory_check(&operation);
    operation.name = "a picture with the opacity of another";
    operation.run = combine;
    dip_out_of_memory_check(&operation);
    operation.name = "a copy of texels";
    operation.run = copy_bgra;
    dip_out_of_memory_check(&operation);
    dip_picture_free(&p.other);
}

// --- animated models -----------------------------------------------------------------------------

typedef struct Animating {
    const char *file;
    DipAnimatedModel *model;
    DipAnimatedPose *pose;
} Animating;

static bool load_and_pose(void *context, DipError *err) {
    Animating *a = context;
    a->model = dip_animated_model_load(a->file, NULL, NULL, err);
    a->pose = a->model ? dip_animated_pose_create(a->model, err) : NULL;
    return a->pose != NULL;
}

static void check_animated(void *context, bool succeeded) {
    const Animating *a = context;
    assert_int_equal(a->pose != NULL, succeeded);
    if (succeeded) {
        assert_int_equal(dip_animated_model_def(a->model)->texture_count, 1);
    }
}

static void free_animated(void *context) {
    Animating *a = context;
    dip_animated_pose_destroy(&a->pose);
    dip_animated_model_destroy(&a->model);
}

static void animated_model_is_loaded_whole_or_not_at_all(void **state) {
    (void)state;
    const char *const files[] = {fixture_data("motion.gltf"), crab};
    for (size_t i = 0; i < sizeof files / sizeof *files; ++i) {
        Animating a = {.file = files[i]};
        dip_out_of_memory_check(&(DipOutOfMemory){.name = files[i],
                                                  .context = &a,
                                                  .run = load_and_pose,
                                                  .check = check_animated,
                                                  .finish = free_animated,
                                                  .short_count = 60});
    }
}

// --- packs ---------------------------------------------------------------------------------------

typedef struct Packing {
    DipScenePack written;
    DipScenePack read;
    FILE *file;
    uint8_t *bytes;
    size_t size_bytes;
} Packing;

static void open_file(void *context) {
    Packing *p = context;
    p->file = tmpfile();
    assert_non_null(p->file);
}

static void close_file(void *context) {
    fclose(((Packing *)context)->file);
}

static bool write_pack(void *context, DipError *err) {
    const Packing *p = context;
    return dip_scene_pack_write(fileno(p->file), &p->written) ||
           dip_error_set_runtime(err, DIP_ERROR_MEMORY, NULL, 0, NULL, "out of memory");
}

static bool read_pack(void *context, DipError *err) {
    Packing *p = context;
    return dip_scene_pack_read(p->bytes, p->size_bytes, &p->read, err);
}

static void check_read(void *context, bool succeeded) {
    static const DipScenePack empty;
    const Packing *p = context;
    if (succeeded) {
        assert_same_scene(&p->written.scene, &p->read.scene);
        assert_true(p->read.warnings.count <= 1); // A list that cannot grow drops a warning.
    } else {
        assert_memory_equal(&p->read, &empty, sizeof empty);
    }
}

static void free_read(void *context) {
    dip_scene_pack_free(&((Packing *)context)->read);
}

static void check_pack_of(const char *path) {
    const DipModelOptions options = {.normal_maps = true, .animation = DIP_MODEL_ANIMATION_FIRST};
    DipModel *model = dip_model_load_with(&path, 1, &options, NULL, NULL, NULL);
    assert_non_null(model);
    Packing p = {.written = {.scene = *dip_model_scene_def(model)}};
    DipError warning;
    dip_error_set(&warning, DIP_ERROR_UNSUPPORTED, "seam.gltf", 0, "key", "a warning");
    warning.severity = DIP_SEVERITY_WARNING;
    dip_error_list_add(&p.written.warnings, &warning);
    dip_out_of_memory_check(&(DipOutOfMemory){.name = "writing a scene pack",
                                              .context = &p,
                                              .prepare = open_file,
                                              .run = write_pack,
                                              .finish = close_file,
                                              .needs_every_allocation = true});
    open_file(&p);
    assert_true(write_pack(&p, NULL));
    p.size_bytes = (size_t)lseek(fileno(p.file), 0, SEEK_END);
    p.bytes = malloc(p.size_bytes);
    assert_true(pread(fileno(p.file), p.bytes, p.size_bytes, 0) == (ssize_t)p.size_bytes);
    close_file(&p);
    dip_out_of_memory_check(&(DipOutOfMemory){.name = "reading a scene pack",
                                              .context = &p,
                                              .run = read_pack,
                                              .check = check_read,
                                              .finish = free_read});
    free(p.bytes);
    dip_error_list_free(&p.written.warnings);
    dip_model_destroy(&model);
}

static void pack_is_written_and_read_whole_or_not_at_all(void **state) {
    (void)state;
    check_pack_of(fixture_data("seam.gltf"));
    check_pack_of(fixture_data("motion.gltf"));
    check_pack_of(crab);
}

// --- a scene that moves --------------------------------------------------------------------------

typedef struct Making {
    const DipSceneDef *def;
    DipScene *scene;
} Making;

static bool make_scene(void *context, DipError *err) {
    Making *making = context;
    making->scene = dip_scene_create(making->def, NULL, err);
    return making->scene != NULL;
}

static void free_scene(void *context) {
    Making *making = context;
    dip_scene_destroy(&making->scene);
}

static void scene_that_moves_is_made_whole_or_not_at_all(void **state) {
    (void)state;
    const char *path = fixture_data("motion.gltf");
    const DipModelOptions options = {.animation = DIP_MODEL_ANIMATION_FIRST};
    DipModel *model = dip_model_load_with(&path, 1, &options, NULL, NULL, NULL);
    assert_non_null(model);
    Making making = {.def = dip_model_scene_def(model)};
    dip_out_of_memory_check(&(DipOutOfMemory){.name = "making a scene that moves",
                                              .context = &making,
                                              .run = make_scene,
                                              .finish = free_scene,
                                              .needs_every_allocation = true});
    dip_model_destroy(&model);
}

// --- cameras -------------------------------------------------------------------------------------

typedef struct Filming {
    const char *file;
    DipModelCameras *cameras;
} Filming;

static bool load_cameras(void *context, DipError *err) {
    Filming *f = context;
    f->cameras = dip_model_cameras_load(f->file, DIP_UP_auto, NULL, err);
    return f->cameras != NULL;
}

static void check_cameras(void *context, bool succeeded) {
    const Filming *f = context;
    assert_int_equal(f->cameras != NULL, succeeded);
    if (succeeded) {
        int count = 0;
        dip_model_cameras_list(f->cameras, &count);
        assert_int_equal(count, 9);
    }
}

static void free_cameras(void *context) {
    Filming *f = context;
    dip_model_cameras_destroy(&f->cameras);
}

#define EYE "{\"camera\":0,\"name\":\"eye\"}"

// The list of nine cameras grows several times.
static void cameras_are_loaded_whole_or_not_at_all(void **state) {
    (void)state;
    fixture_write_text("cameras.gltf",
                       "{\"asset\":{\"version\":\"2.0\"},\"cameras\":[{\"type\":\"perspective\","
                       "\"perspective\":{\"yfov\":0.8,\"znear\":0.1}}],\"scene\":0,"
                       "\"scenes\":[{\"nodes\":[0,1,2,3,4,5,6,7,8]}],\"nodes\":[" EYE "," EYE
                       "," EYE "," EYE "," EYE "," EYE "," EYE "," EYE "," EYE "]}");
    Filming filming = {.file = fixture_path("cameras.gltf")};
    dip_out_of_memory_check(&(DipOutOfMemory){.name = "loading cameras",
                                              .context = &filming,
                                              .run = load_cameras,
                                              .check = check_cameras,
                                              .finish = free_cameras});
}

int main(int argc, char **argv) {
    if (argc > 1 && strcmp(argv[1], importer_word) == 0) {
        return dip_importer_run(argc - 2, argv + 2);
    }
    dip_out_of_memory_read_options(argc, argv);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(model_is_loaded_whole_or_not_at_all),
        cmocka_unit_test(model_is_imported_whole_or_not_at_all),
        cmocka_unit_test(picture_is_read_whole_or_not_at_all),
        cmocka_unit_test(animated_model_is_loaded_whole_or_not_at_all),
        cmocka_unit_test(pack_is_written_and_read_whole_or_not_at_all),
        cmocka_unit_test(scene_that_moves_is_made_whole_or_not_at_all),
        cmocka_unit_test(cameras_are_loaded_whole_or_not_at_all),
    };
    return cmocka_run_group_tests(tests, fixture_open, fixture_close);
}
