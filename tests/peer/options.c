// The option table of the peer bench, its parser and its help.
#include "tests/peer/options.h"

#include "app/bench/synthetic.h"
#include "renderer/base/assert.h"
#include "renderer/base/number.h"
#include "renderer/scene/renderer.h"
#include "tests/peer/measure.h"

#include <string.h>

enum { MAX_FRAMES = 10000, MAX_ROUNDS = 1000, MAX_PEER_THREADS = 32 };

typedef bool SetOption(DipPeerOptions *options, const char *key, const char *value, DipError *err);

static bool refuse(DipError *err, const char *key, const char *value, const char *accepted) {
    return dip_error_set(err, DIP_ERROR_RANGE, NULL, 0, key, "'%s' is not valid; give %s", value,
                         accepted);
}

static bool parse_integer(const char *text, int low, int high, int *value) {
    return dip_integer_parse(text, strlen(text), value) && *value >= low && *value <= high;
}

static bool set_model(DipPeerOptions *options, const char *key, const char *value, DipError *err) {
    if (options->model_count == DIP_PEER_MAX_MODELS) {
        return refuse(err, key, value, "at most 64 files");
    }
    options->scene = DIP_PEER_SCENE_MODELS;
    options->models[options->model_count++] = value;
    return true;
}

static bool set_scene(DipPeerOptions *options, const char *key, const char *value, DipError *err) {
    if (strcmp(value, "large") == 0) {
        options->scene = DIP_PEER_SCENE_LARGE;
    } else if (strcmp(value, "tiny") == 0) {
        options->scene = DIP_PEER_SCENE_TINY;
    } else if (strncmp(value, "grid=", 5) == 0 &&
               parse_integer(value + 5, 2, DIP_SYNTHETIC_MAX_TRIANGLES, &options->grid_triangles)) {
        options->scene = DIP_PEER_SCENE_GRID;
    } else {
        return refuse(err, key, value, "large, tiny, or grid=N with N from 2 to 20000000");
    }
    return true;
}

static bool set_api(DipPeerOptions *options, const char *key, const char *value, DipError *err) {
    for (int i = 0; i < DIP_PEER_API_COUNT; i++) {
        if (strcmp(value, dip_peer_api_names[i]) == 0) {
            options->api = (DipPeerApi)i;
            return true;
        }
    }
    return refuse(err, key, value, "gl or vulkan");
}

static bool set_path(DipPeerOptions *options, const char *key, const char *value, DipError *err) {
    (void)key;
    (void)err;
    options->path = value;
    return true;
}

static bool set_fov(DipPeerOptions *options, const char *key, const char *value, DipError *err) {
    return (dip_number_parse(value, strlen(value), &options->fov_y_deg) &&
            options->fov_y_deg >= 1.0 && options->fov_y_deg <= 170.0) ||
           refuse(err, key, value, "an angle from 1 to 170 degrees");
}

static bool set_turn(DipPeerOptions *options, const char *key, const char *value, DipError *err) {
    return (dip_number_parse(value, strlen(value), &options->turn_deg) &&
            options->turn_deg >= -180.0 && options->turn_deg <= 180.0) ||
           refuse(err, key, value, "an angle from -180 to 180 degrees");
}

static bool set_size(DipPeerOptions *options, const char *key, const char *value, DipError *err) {
    const char *times = strchr(value, 'x');
    return (times && dip_integer_parse(value, (size_t)(times - value), &options->width) &&
            options->width >= 1 && options->width <= DIP_MAX_FRAME_SIZE &&
            parse_integer(times + 1, 1, DIP_MAX_FRAME_SIZE, &options->height)) ||
           refuse(err, key, value, "WIDTHxHEIGHT, each from 1 to 8192 pixels");
}

static bool set_threads(DipPeerOptions *options, const char *key, const char *value,
                        DipError *err) {
    return parse_integer(value, 1, MAX_PEER_THREADS, &options->threads) ||
           refuse(err, key, value, "a number from 1 to 32");
}

static bool set_isa(DipPeerOptions *options, const char *key, const char *value, DipError *err) {
    return (dip_isa_parse(value, &options->isa) && dip_isa_available(options->isa)) ||
           refuse(err, key, value,
                  "one of scalar, sse2, avx2, avx512 and neon that this processor has");
}

static bool set_frames(DipPeerOptions *options, const char *key, const char *value, DipError *err) {
    return parse_integer(value, 1, MAX_FRAMES, &options->frames) ||
           refuse(err, key, value, "a number from 1 to 10000");
}

static bool set_rounds(DipPeerOptions *options, const char *key, const char *value, DipError *err) {
    return parse_integer(value, 1, MAX_ROUNDS, &options->rounds) ||
           refuse(err, key, value, "a number from 1 to 1000");
}

static bool set_rows(DipPeerOptions *options, const char *key, const char *value, DipError *err) {
    options->rows = 0;
    for (const char *name = value; *name;) {
        const size_t length = strcspn(name, ",");
        const int row = dip_peer_row_find(name, length);
        if (row < 0) {
            return refuse(err, key, value, "a list of none,af4,af16,4x,4x+af16,8x,8x+af16");
        }
        options->rows |= 1u << row;
        name += length + (name[length] == ',');
    }
    return true;
}

static bool set_csv(DipPeerOptions *options, const char *key, const char *value, DipError *err) {
    (void)key;
    (void)err;
    options->csv = value;
    return true;
}

static bool set_append(DipPeerOptions *options, const char *key, const char *value, DipError *err) {
    const char *comma = strchr(value, ',');
    const size_t length = comma ? (size_t)(comma - value) : 0;
    if (length == 0 || length >= sizeof options->label || !comma[1]) {
        return refuse(err, key, value, "LABEL,FILE");
    }
    memcpy(options->label, value, length);
    options->label[length] = '\0';
    options->append = comma + 1;
    return true;
}

static bool set_pictures(DipPeerOptions *options, const char *key, const char *value,
                         DipError *err) {
    (void)key;
    (void)err;
    options->pictures = value;
    return true;
}

static bool set_check(DipPeerOptions *options, const char *key, const char *value, DipError *err) {
    (void)key;
    (void)value;
    (void)err;
    options->check = true;
    return true;
}

static bool set_help(DipPeerOptions *options, const char *key, const char *value, DipError *err) {
    (void)key;
    (void)value;
    (void)err;
    options->help = true;
    return true;
}

static const struct {
    const char *name;
    const char *argument; // NULL if the option takes no value
    SetOption *set;
    const char *text;
} rows[] = {
    {"--model", "FILE", set_model, "draw a model instead of the courtyard; may be repeated"},
    {"--scene", "NAME", set_scene, "draw a synthetic scene: large, tiny or grid=N"},
    {"--api", "NAME", set_api, "the peer: gl (llvmpipe) or vulkan (lavapipe) (gl)"},
    {"--path", "FILE", set_path, "follow this camera path, not the scene's own (models: an orbit)"},
    {"--fov", "DEG", set_fov, "vertical field of view, in degrees"},
    {"--turn", "DEG", set_turn,
     "tiny, grid: turn the camera left; at 40, half is in view, at 180, nothing (0)"},
    {"--size", "WxH", set_size, "size of the frames in pixels (640x480)"},
    {"--threads", "N", set_threads, "threads of each side (2)"},
    {"--isa", "NAME", set_isa, "Diptych's instruction set (the best of this processor)"},
    {"--frames", "N", set_frames,
     "number of frames, spread evenly over the path (16; with --check 6)"},
    {"--rounds", "N", set_rounds, "how often each frame is measured (5)"},
    {"--rows", "LIST", set_rows, "rows to measure: none,af4,af16,4x,4x+af16,8x,8x+af16 (all)"},
    {"--csv", "FILE", set_csv, "write the times of every measured frame to this file"},
    {"--append", "L,FILE", set_append, "append a line per row, with the label L, to this file"},
    {"--pictures", "DIR", set_pictures, "write both pictures of every row and frame there, as PPM"},
    {"--check", NULL, set_check,
     "only compare pictures; exit with 1 if a row without AF is below 40 dB"},
    {"--help", NULL, set_help, "print this help"},
};

static bool parse_option(int argc, char *const *argv, int *index, DipPeerOptions *options,
                         DipError *err) {
    const char *name = argv[*index];
    for (size_t i = 0; i < DIP_ARRAY_COUNT(rows); i++) {
        if (strcmp(rows[i].name, name) != 0) {
            continue;
        }
        if (!rows[i].argument) {
            return rows[i].set(options, name, NULL, err);
        }
        if (*index + 1 == argc) {
            return dip_error_set(err, DIP_ERROR_MISSING, NULL, 0, name,
                                 "the value is missing; give %s", rows[i].argument);
        }
        return rows[i].set(options, name, argv[++*index], err);
    }
    return dip_error_set(err, DIP_ERROR_UNKNOWN, NULL, 0, name,
                         "no such option; --help lists the options");
}

bool dip_peer_options_parse(int argc, char *const *argv, DipPeerOptions *options, DipError *err) {
    *options = (DipPeerOptions){
        .width = 640, .height = 480, .threads = 2, .isa = dip_isa_best(), .rounds = 5};
    for (int i = 1; i < argc; i++) {
        if (!parse_option(argc, argv, &i, options, err)) {
            return false;
        }
    }
    if (options->model_count && options->scene != DIP_PEER_SCENE_MODELS) {
        return dip_error_set(err, DIP_ERROR_CONFLICT, NULL, 0, "--scene",
                             "cannot be combined with --model; give one of them");
    }
    if (!options->frames) {
        options->frames = options->check ? 6 : 16;
    }
    if (!options->rows) {
        options->rows = options->check ? dip_peer_rows_alike() : ~0u;
    }
    return true;
}

void dip_peer_options_help(FILE *out) {
    fprintf(out,
            "Draws the same frames with Diptych's renderer and with Mesa's llvmpipe or lavapipe, "
            "in turn.\n"
            "Usage: dip_peer [OPTION]...\n\n");
    for (size_t i = 0; i < DIP_ARRAY_COUNT(rows); i++) {
        fprintf(out, "  %-10s %-6s %s\n", rows[i].name, rows[i].argument ? rows[i].argument : "",
                rows[i].text);
    }
    fprintf(
        out,
        "\nExit codes: 0 success, 1 failure, 2 bad command line, 77 the peer is not installed.\n"
        "docs/peer.md explains the table.\n");
}
