// Tests of the importer process. This program is also its own importer: started with a word such as
// "crash" as its first argument, it misbehaves in that way.
#define _GNU_SOURCE // F_ADD_SEALS
#include "assets/importer.h"
#include "assets/importer_private.h"
#include "assets/pack/scene_pack.h"
#include "renderer/base/clock.h"
#include "tests/assets/fixture.h"
#include "tests/assets/same_scene.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <pthread.h>
#include <setjmp.h>
#include <signal.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>
#include <cmocka.h>

// The files that an importer inherits (assets/importer_private.h).
enum { PACK_FILE = 3, PIPE = 4 };

static const bool sanitized = IMPORT_IS_SANITIZED;

// --- importers that misbehave --------------------------------------------------------------------

static void seal_and_report(void) {
    fcntl(PACK_FILE, F_ADD_SEALS, F_SEAL_WRITE | F_SEAL_SHRINK | F_SEAL_GROW | F_SEAL_SEAL);
    if (write(PIPE, "", 1) != 1) {
        _exit(99);
    }
}

static void end_by(int signal_number) {
    dip_scene_pack_note(PACK_FILE, DIP_IMPORT_READS, 0);
    signal(signal_number, SIG_DFL); // Sanitizers have handlers of their own.
    raise(signal_number);
}

static void write_garbage(void) {
    char garbage[3000];
    memset(garbage, 0xa5, sizeof garbage);
    if (pwrite(PACK_FILE, garbage, sizeof garbage, 0) < 0) {
        _exit(99);
    }
    seal_and_report();
}

static void spin(void) {
    for (volatile uint64_t i = 0; i < UINT64_MAX; ++i) {
    }
}

// Linux seals no file against writing while it is mapped for writing.
enum { MAPPED_BYTES = 4096 };

static void *map_pack(void) {
    return mmap(NULL, MAPPED_BYTES, PROT_READ | PROT_WRITE, MAP_SHARED, PACK_FILE, 0);
}

static void *unmap_soon(void *mapping) {
    poll(NULL, 0, 300);
    munmap(mapping, MAPPED_BYTES);
    return NULL;
}

static int misbehave(const char *how, int count, char **arguments) {
    if (strcmp(how, "well") == 0) {
        return dip_importer_run(count, arguments);
    } else if (strcmp(how, "busy") == 0) {
        map_pack();
        return dip_importer_run(count, arguments);
    } else if (strcmp(how, "busy-for-a-while") == 0) {
        pthread_t thread;
        pthread_create(&thread, NULL, unmap_soon, map_pack());
        return dip_importer_run(count, arguments);
    } else if (strcmp(how, "no-space") == 0) {
        return write(PIPE, &(unsigned char){ENOSPC}, 1) == 1 ? 4 : 99;
    } else if (strcmp(how, "crash") == 0) {
        end_by(SIGSEGV);
    } else if (strcmp(how, "abort") == 0) {
        end_by(SIGABRT);
    } else if (strcmp(how, "user-signal") == 0) {
        end_by(SIGUSR1);
    } else if (strcmp(how, "hang") == 0) {
        dip_scene_pack_note(PACK_FILE, DIP_IMPORT_PICTURES, 0);
        pause();
    } else if (strcmp(how, "hang-closed") == 0) {
        close(PIPE);
        pause();
    } else if (strcmp(how, "spin") == 0) {
        end_by(SIGXCPU);
        spin();
    } else if (strcmp(how, "garbage") == 0) {
        write_garbage();
    } else if (strcmp(how, "unfinished") == 0) {
        dip_scene_pack_note(PACK_FILE, DIP_IMPORT_READS, 0);
        seal_and_report();
    } else if (strcmp(how, "unsealed") == 0) {
        const DipScenePack pack = {.failure = {.code = DIP_ERROR_RANGE}};
        dip_scene_pack_write(PACK_FILE, &pack);
        return write(PIPE, "", 1) == 1 ? 0 : 99;
    } else if (strcmp(how, "exit") == 0) {
        return 7;
    }
    return 0;
}

// --- tests ---------------------------------------------------------------------------------------

static DipImporter importer_that(const char *how) {
    return (DipImporter){.program = "/proc/self/exe", .command = how};
}

static int open_files(void) {
    int count = 0;
    DIR *listing = opendir("/proc/self/fd");
    assert_non_null(listing);
    while (readdir(listing)) {
        count++;
    }
    closedir(listing);
    return count;
}

static DipModel *import_with(const DipModelOptions *options, const char *path,
                             DipErrorList *warnings, DipError *err) {
    const int files_before = open_files();
    DipModel *model = dip_model_load_with(&path, 1, options, NULL, warnings, err);
    assert_int_equal(open_files(), files_before);
    assert_true(waitpid(-1, NULL, WNOHANG) < 0 && errno == ECHILD); // No process is left behind.
    return model;
}

static DipModel *import(const DipImporter *importer, const char *path, DipErrorList *warnings,
                        DipError *err) {
    const DipModelOptions options = {.normal_maps = true, .importer = importer};
    return import_with(&options, path, warnings, err);
}

static void assert_fails(const DipImporter *importer, const char *path, DipErrorCode code,
                         const char *reason) {
    DipError err = {0};
    DipModel *model = import(importer, path, NULL, &err);
    if (model || err.code != code || !strstr(err.message, reason)) {
        fail_msg("%s: code %s, message \"%s\"", importer->command ? importer->command : "",
                 dip_error_code_name(err.code), err.message);
    }
    assert_int_equal(err.origin, DIP_ORIGIN_INPUT);
    assert_string_equal(err.file, path);
}

static void an_importer_that_crashes_fails_the_load(void **state) {
    (void)state;
    const char *path = fixture_data("square.obj");
    const DipImporter crash = importer_that("crash");
    assert_fails(&crash, path, DIP_ERROR_RUNTIME,
                 "the importer crashed while it read the model (SIGSEGV)");
    const DipImporter abort_ = importer_that("abort");
    assert_fails(&abort_, path, DIP_ERROR_RUNTIME, "(SIGABRT)");
    char number[32]; // A signal that is no usual end has no name.
    snprintf(number, sizeof number, "(signal %d)", SIGUSR1);
    const DipImporter user = importer_that("user-signal");
    assert_fails(&user, path, DIP_ERROR_RUNTIME, number);
    const DipImporter leaves = importer_that("exit");
    assert_fails(&leaves, path, DIP_ERROR_RUNTIME, "exit code 7 and without a result");
    const DipImporter nothing = importer_that("nothing");
    assert_fails(&nothing, path, DIP_ERROR_RUNTIME, "exit code 0 and without a result");
}

static void an_importer_that_hangs_is_ended(void **state) {
    (void)state;
    const char *path = fixture_data("square.obj");
    static const char *const ways[] = {"hang", "hang-closed"};
    for (int i = 0; i < 2; ++i) {
        DipImporter hang = importer_that(ways[i]);
        hang.wall_s = 1;
        const int64_t begin_ns = dip_clock_ns();
        assert_fails(&hang, path, DIP_ERROR_OVERSIZED, "the importer hung while it");
        // Waits count whole milliseconds, so the last one may end up to a millisecond early.
        assert_in_range(dip_clock_ns() - begin_ns, 999000000, 20000000000);
    }
}

static void the_end_of_the_processor_time_is_told(void **state) {
    (void)state;
    DipImporter spins = importer_that("spin");
    spins.cpu_s = 4;
    assert_fails(&spins, fixture_data("square.obj"), DIP_ERROR_OVERSIZED,
                 "the importer used up its processor time while it read the model, accepted 4 s");
}

static void a_pack_that_is_not_whole_is_refused(void **state) {
    (void)state;
    const char *path = fixture_data("square.obj");
    const DipImporter garbage = importer_that("garbage");
    assert_fails(&garbage, path, DIP_ERROR_FORMAT, "malformed: it is not of this version");
    const DipImporter unfinished = importer_that("unfinished");
    assert_fails(&unfinished, path, DIP_ERROR_FORMAT, "malformed: it is incomplete");
    const DipImporter unsealed = importer_that("unsealed");
    assert_fails(&unsealed, path, DIP_ERROR_FORMAT, "not sealed");
}

static void a_program_that_is_no_importer_is_refused(void **state) {
    (void)state;
    const char *path = fixture_data("square.obj");
    const DipImporter other = {.program = "/bin/true"};
    assert_fails(&other, path, DIP_ERROR_RUNTIME, "without a result");
    const DipImporter missing = {.program = "/no/such/program"};
    DipError err = {0};
    assert_null(import(&missing, path, NULL, &err));
    assert_int_equal(err.origin, DIP_ORIGIN_RUNTIME);
    assert_non_null(strstr(err.message, "cannot start the importer /no/such/program"));
}

// The file is 3 GiB of nothing, which the reader wants to hold in memory.
static void memory_is_limited(void **state) {
    (void)state;
    if (sanitized) {
        return; // AddressSanitizer does not run with limited address space.
    }
    static const char header[] = "ply\nformat binary_little_endian 1.0\nelement vertex 200000000\n"
                                 "property float x\nproperty float y\nproperty float z\n"
                                 "element face 1\nproperty list uchar int vertex_indices\n"
                                 "end_header\n";
    fixture_write("huge.ply", header, strlen(header));
    const char *path = fixture_path("huge.ply");
    assert_int_equal(truncate(path, (off_t)3 << 30), 0);
    DipImporter well = importer_that("well");
    well.memory_bytes = 64 << 20;
    DipError err = {0};
    assert_null(import(&well, path, NULL, &err));
    assert_string_equal(err.file, path);
    assert_int_equal(err.code, DIP_ERROR_OVERSIZED);
    assert_non_null(strstr(err.message, "out of memory, accepted 64 MiB"));
}

static void a_scene_that_is_too_large_to_hand_over_is_refused(void **state) {
    (void)state;
    DipImporter well = importer_that("well");
    well.memory_bytes = 300; // Room for notes only.
    assert_fails(&well, fixture_data("seam.gltf"), DIP_ERROR_OVERSIZED, "does not fit into memory");
}

static void assert_cannot_hand_over(const char *how, int reason) {
    const DipImporter importer = importer_that(how);
    DipError err = {0};
    assert_null(import(&importer, fixture_data("square.obj"), NULL, &err));
    assert_int_equal(err.code, DIP_ERROR_RUNTIME);
    assert_int_equal(err.origin, DIP_ORIGIN_RUNTIME);
    assert_non_null(strstr(err.message, "could not hand over the model: "));
    assert_non_null(strstr(err.message, strerror(reason)));
}

static void a_failure_of_the_system_is_told_and_is_not_bad_input(void **state) {
    (void)state;
    assert_cannot_hand_over("no-space", ENOSPC);
    assert_cannot_hand_over("busy", EBUSY);
}

static void a_pack_that_is_busy_for_a_while_is_sealed_later(void **state) {
    (void)state;
    const char *path = fixture_data("square.obj");
    const DipImporter busy = importer_that("busy-for-a-while");
    DipError err = {0};
    DipModel *model = import(&busy, path, NULL, &err);
    if (!model) {
        fail_msg("%s", err.message);
    }
    dip_model_destroy(&model);
}

// The same scene and the same warnings as in this process, or the same error.
static void assert_imports_alike_with(DipModelOptions options, const char *path) {
    const DipImporter well = importer_that("well");
    DipErrorList warnings[2] = {{0}, {0}};
    DipError err[2] = {{0}, {0}};
    DipModel *here = import_with(&options, path, &warnings[0], &err[0]);
    options.importer = &well;
    DipModel *there = import_with(&options, path, &warnings[1], &err[1]);
    if (!here != !there) {
        fail_msg("%s: here \"%s\", there \"%s\"", path, err[0].message, err[1].message);
    }
    if (here) {
        assert_same_scene(dip_model_scene_def(here), dip_model_scene_def(there));
        assert_int_equal(warnings[0].count, warnings[1].count);
        for (size_t i = 0; i < warnings[0].count; ++i) {
            assert_string_equal(warnings[0].items[i].message, warnings[1].items[i].message);
        }
    } else {
        assert_memory_equal(&err[0], &err[1], sizeof err[0]);
    }
    dip_model_destroy(&here);
    dip_model_destroy(&there);
    dip_error_list_free(&warnings[0]);
    dip_error_list_free(&warnings[1]);
}

static void assert_imports_alike(const char *path) {
    assert_imports_alike_with((DipModelOptions){.normal_maps = true}, path);
}

// Each option changes the scene, or the error: it reaches the importer.
static void every_option_reaches_the_importer(void **state) {
    (void)state;
    static const DipMaterialRule fitting[] = {
        {DIP_MARK_SKY, "no*", NULL, NULL, 0, NULL},
        {DIP_MARK_GLASS, "p?inted", NULL, "a.ini", 7, "MATERIAL_GLASS"},
    };
    static const DipMaterialRule unknown[] = {
        {DIP_MARK_CLIP, "paint*", NULL, "a.ini", 8, "MATERIAL_CLIP"},
        {DIP_MARK_WATER, "pool", NULL, "b.ini", 9, "MATERIAL_WATER"},
    };
    const char *const square = fixture_data("square.obj");
    const char *const lit = fixture_data("lights.gltf");
    const char *const moving = fixture_data("motion.gltf");
    const struct {
        const char *path;
        DipModelOptions options;
    } cases[] = {
        {square, {.rules = fitting + 1, .rule_count = 1}},
        {square, {.rules = fitting, .rule_count = 2}},
        {square, {.rules = unknown, .rule_count = 1}},
        {square, {.rules = unknown, .rule_count = 2}},
        {square, {.up = DIP_UP_z}},
        {square, {.shading = DIP_MODEL_SHADING_flat}},
        {lit, {.has_light_scale = true, .light_scale = 0.37}},
        {moving, {.animation = DIP_MODEL_ANIMATION_FIRST}},
        {moving, {.animation = DIP_MODEL_ANIMATION_NAMED, .animation_name = "no such"}},
        {moving,
         {.animation = DIP_MODEL_ANIMATION_FIRST,
          .animation_is_held = true,
          .animation_held_s = 0.41}},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
        assert_imports_alike_with(cases[i].options, cases[i].path);
    }
}

static void every_test_model_imports_as_in_this_process(void **state) {
    (void)state;
    DIR *listing = opendir(DIP_TEST_DATA);
    assert_non_null(listing);
    for (struct dirent *entry = readdir(listing); entry; entry = readdir(listing)) {
        if (entry->d_name[0] != '.') {
            assert_imports_alike(fixture_data(entry->d_name));
        }
    }
    closedir(listing);
}

static void the_courtyard_imports_as_in_this_process(void **state) {
    (void)state;
    assert_imports_alike(DIP_ASSETS_DIR "/courtyard/court.gltf");
}

static void a_picture_is_imported_as_in_this_process(void **state) {
    (void)state;
    const DipImporter well = importer_that("well");
    static const char *const names[] = {"leaf.png", "door.jpg", "no_such.png", "court.gltf"};
    for (size_t i = 0; i < sizeof names / sizeof names[0]; ++i) {
        char path[FIXTURE_PATH];
        snprintf(path, sizeof path, "%s/courtyard/%s", DIP_ASSETS_DIR, names[i]);
        DipPicture here;
        DipPicture there;
        DipError err[2] = {{0}, {0}};
        const bool read = dip_picture_read_file(path, &here, &err[0]);
        assert_int_equal(dip_picture_import(path, &well, &there, &err[1]), read);
        assert_int_equal(read, i < 2);
        assert_memory_equal(&err[0], &err[1], sizeof err[0]);
        assert_int_equal(here.width, there.width);
        assert_int_equal(here.has_alpha, there.has_alpha);
        if (read) {
            assert_memory_equal(here.rgba8, there.rgba8,
                                4 * (size_t)here.width * (size_t)here.height);
        }
        dip_picture_free(&here);
        dip_picture_free(&there);
    }
    const DipImporter crash = importer_that("crash");
    DipPicture none;
    DipError err = {0};
    assert_false(dip_picture_import("x.png", &crash, &none, &err));
    assert_null(none.rgba8);
    assert_non_null(strstr(err.message, "the importer crashed"));
}

// --- extreme pictures ----------------------------------------------------------------------------

// Writes a run-length encoded TGA of one grey, and a square that shows it.
static void write_textured_square(int width, int height) {
    fixture_copy("square.obj");
    fixture_write_text("square.mtl", "newmtl painted\nKd 1 1 1\nmap_Kd colour.tga\n");
    FILE *file = fopen(fixture_path("colour.tga"), "wb");
    assert_non_null(file);
    const uint8_t header[18] = {[2] = 10,
                                [12] = (uint8_t)width,
                                [13] = (uint8_t)(width >> 8),
                                [14] = (uint8_t)height,
                                [15] = (uint8_t)(height >> 8),
                                [16] = 24,
                                [17] = 0x20};
    fwrite(header, 1, sizeof header, file);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; x += 128) {
            const int run = width - x < 128 ? width - x : 128;
            const uint8_t packet[4] = {(uint8_t)(0x80 + run - 1), 90, 90, 90};
            fwrite(packet, 1, sizeof packet, file);
        }
    }
    assert_int_equal(fclose(file), 0);
}

static void textures_of_every_size_are_imported(void **state) {
    (void)state;
    static const int sizes[][2] = {{1, 1},    {1, 4096}, {4096, 1}, {3, 5},
                                   {1023, 7}, {8191, 3}, {1, 8192}, {8192, 8192}};
    const DipImporter well = importer_that("well");
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0] - sanitized; ++i) {
        write_textured_square(sizes[i][0], sizes[i][1]);
        DipError err = {0};
        DipModel *model = import(&well, fixture_path("square.obj"), NULL, &err);
        assert_non_null(model);
        const DipSceneDef *def = dip_model_scene_def(model);
        assert_int_equal(def->texture_count, 1);
        assert_int_equal(def->textures[0].width, sizes[i][0]);
        assert_int_equal(def->textures[0].height, sizes[i][1]);
        DipScene *scene = dip_scene_create(def, NULL, &err);
        assert_non_null(scene);
        dip_scene_destroy(&scene);
        dip_model_destroy(&model);
    }
}

static void a_texture_beyond_the_limit_is_left_out_with_a_warning(void **state) {
    (void)state;
    const DipImporter well = importer_that("well");
    write_textured_square(8193, 1);
    DipErrorList warnings = {0};
    DipModel *model = import(&well, fixture_path("square.obj"), &warnings, NULL);
    assert_non_null(model);
    assert_int_equal(dip_model_scene_def(model)->texture_count, 0);
    assert_int_equal(warnings.count, 1);
    assert_non_null(strstr(warnings.items[0].message, "8193 x 1 pixels, accepted 1..8192"));
    dip_error_list_free(&warnings);
    dip_model_destroy(&model);
}

static void nobody_else_can_start_an_importer(void **state) {
    (void)state;
    char *no_arguments[] = {NULL};
    assert_int_equal(dip_importer_run(0, no_arguments), DIP_IMPORTER_MISUSED);
    char *words[] = {"--", "2", "2", "3", "4", "0", "0", "0", "7", "8", "a.obj", NULL};
    assert_int_equal(dip_importer_run(11, words), DIP_IMPORTER_MISUSED);
    words[3] = "three";
    assert_int_equal(dip_importer_run(11, words), DIP_IMPORTER_MISUSED);
}

// Each list is an allocation of its own, so that the address sanitizer sees a read behind it.
static void lists_of_arguments_are_read_to_their_ends_only(void **state) {
    (void)state;
    static char one[] = "1";
    for (int count = 1; count <= IMPORT_ARGUMENT_COUNT + 1; ++count) {
        char **arguments = malloc((size_t)count * sizeof *arguments);
        assert_non_null(arguments);
        for (int i = 0; i < count; ++i) {
            arguments[i] = one;
        }
        assert_int_equal(dip_importer_run(count, arguments), DIP_IMPORTER_MISUSED);
        free(arguments);
    }
}

int main(int argc, char **argv) {
    if (argc > 1) {
        return misbehave(argv[1], argc - 2, argv + 2);
    }
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(an_importer_that_crashes_fails_the_load),
        cmocka_unit_test(an_importer_that_hangs_is_ended),
        cmocka_unit_test(the_end_of_the_processor_time_is_told),
        cmocka_unit_test(a_pack_that_is_not_whole_is_refused),
        cmocka_unit_test(a_program_that_is_no_importer_is_refused),
        cmocka_unit_test(memory_is_limited),
        cmocka_unit_test(a_scene_that_is_too_large_to_hand_over_is_refused),
        cmocka_unit_test(a_failure_of_the_system_is_told_and_is_not_bad_input),
        cmocka_unit_test(a_pack_that_is_busy_for_a_while_is_sealed_later),
        cmocka_unit_test(every_option_reaches_the_importer),
        cmocka_unit_test(every_test_model_imports_as_in_this_process),
        cmocka_unit_test(the_courtyard_imports_as_in_this_process),
        cmocka_unit_test(a_picture_is_imported_as_in_this_process),
        cmocka_unit_test(textures_of_every_size_are_imported),
        cmocka_unit_test(a_texture_beyond_the_limit_is_left_out_with_a_warning),
        cmocka_unit_test(nobody_else_can_start_an_importer),
        cmocka_unit_test(lists_of_arguments_are_read_to_their_ends_only),
    };
    return cmocka_run_group_tests_name("importer", tests, fixture_open, fixture_close);
}
