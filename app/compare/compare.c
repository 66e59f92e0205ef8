// Implements the command `diptych compare`: reads two pictures, applies a filter to the first one
// if the command names one, and prints how much the pictures differ.
#include "app/compare/compare.h"

#include "app/cost/options.h"
#include "app/files/pictures.h"
#include "app/files/put.h"
#include "app/measure/metrics/meter.h"
#include "assets/picture.h"
#include "renderer/base/assert.h"
#include "renderer/post/post.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const char *const filter_names[] = {"none",
#define FILTER_NAME(name, NAME, text) #name,
                                           DIP_POST_LIST(FILTER_NAME)
#undef FILTER_NAME
};

typedef struct CompareOptions {
    DipProgramOptions program;
    const char *files[2];
    int file_count;
    int filter; // 0: none; otherwise a DipPostFilter plus 1.
    double sharpness;
    double pixels_per_degree;
    const char *save; // File for the filtered picture, or NULL.
    const char *map;  // File for the picture of FLIP, or NULL.
    bool json;
} CompareOptions;

// How much two pictures differ.
typedef struct Comparison {
    DipMetrics metrics;
    uint64_t other_pixels; // Number of pixels whose sRGB codes differ; alpha is ignored.
    int greatest;          // Greatest difference of a channel's codes in the two pictures.
    DipPostWork work;      // What the filter did.
} Comparison;

// --- the filter ----------------------------------------------------------------------------------

static bool check_sizes(const CompareOptions *options, const DipPicture *a, const DipPicture *b,
                        DipError *err) {
    if (a->width == b->width && a->height == b->height) {
        return true;
    }
    const bool enlarges =
        options->filter && dip_post_enlarges((DipPostFilter)(options->filter - 1));
    if (enlarges && a->width <= b->width && a->height <= b->height) {
        return true;
    }
    return dip_error_set(err, DIP_ERROR_CONFLICT, options->files[0], 0, NULL,
                         "has %d x %d pixels and %.100s has %d x %d; accepted: pictures of one "
                         "size, or a smaller first picture with --filter bilinear, bicubic or easu",
                         a->width, a->height, options->files[1], b->width, b->height);
}

// Replaces the picture by the filtered one, which has the given size.
static bool apply_filter(const CompareOptions *options, DipPicture *picture, int width, int height,
                         DipPostWork *work, DipError *err) {
    const DipPostDef def = {
        .filter = (DipPostFilter)(options->filter - 1),
        .from_width = picture->width,
        .from_height = picture->height,
        .to_width = width,
        .to_height = height,
        .sharpness = (float)options->sharpness,
        .isa = dip_isa_best(),
    };
    DipPost *post = dip_post_create(&def, err);
    uint8_t *to = post ? malloc((size_t)width * (size_t)height * 4) : NULL;
    if (to) {
        *work =
            dip_post_run(post, picture->rgba8, (size_t)picture->width * 4, to, (size_t)width * 4);
        free(picture->rgba8);
        picture->rgba8 = to;
        picture->width = width;
        picture->height = height;
        picture->level_count = 1;
    } else if (post) {
        dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "compare", "out of memory");
    }
    dip_post_destroy(&post);
    return to != NULL;
}

// --- measuring -----------------------------------------------------------------------------------

static void count_differences(const DipPicture *a, const DipPicture *b, Comparison *found) {
    const size_t count = (size_t)a->width * (size_t)a->height;
    for (size_t i = 0; i < count; i++) {
        int greatest = 0;
        for (size_t c = 4 * i; c < 4 * i + 3; c++) {
            const int difference = abs(a->rgba8[c] - b->rgba8[c]);
            greatest = difference > greatest ? difference : greatest;
        }
        found->other_pixels += greatest > 0;
        found->greatest = greatest > found->greatest ? greatest : found->greatest;
    }
}

// Returns the picture in linear light, 3 values per pixel, which the caller frees; NULL when memory
// runs out.
static float *linear_light(const DipPicture *picture, const DipFlip *flip) {
    const size_t count = (size_t)picture->width * (size_t)picture->height;
    float *light = malloc(count * 3 * sizeof *light);
    for (size_t i = 0; light && i < 3 * count; i++) {
        light[i] = flip->light[picture->rgba8[i / 3 * 4 + i % 3]];
    }
    return light;
}

static bool write_map(const char *file, const float *flip, int width, int height, DipError *err) {
    const size_t count = (size_t)width * (size_t)height;
    uint8_t *rgba8 = malloc(count * 4);
    if (!rgba8) {
        return dip_error_set(err, DIP_ERROR_MEMORY, file, 0, NULL, "out of memory");
    }
    for (size_t i = 0; i < count; i++) {
        dip_magma(flip[i], rgba8 + 4 * i);
        rgba8[4 * i + 3] = 255;
    }
    const bool written = dip_png_write_rgba8(file, rgba8, (size_t)width * 4, width, height, err);
    free(rgba8);
    return written;
}

static bool measure(const CompareOptions *options, const DipPicture *a, const DipPicture *b,
                    Comparison *found, DipError *err) {
    const DipSrgbPicture test = {a->rgba8, (size_t)a->width * 4, a->width, a->height};
    DipMeterStandard standard = {
        {b->rgba8, (size_t)b->width * 4, b->width, b->height}, NULL, NULL, NULL};
    DipMeter meter;
    DipMetricSums sums = {0};
    bool ok =
        dip_meter_init(&meter, DIP_METER_PICTURES, a->width, a->height, options->pixels_per_degree);
    if (!ok) {
        return dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "compare", "out of memory");
    }
    float *test_lin = linear_light(a, &meter.flip);
    float *standard_lin = linear_light(b, &meter.flip);
    // Without a scene, nothing is known about what a pixel shows, so all pixels have class 0. Only
    // the result for the whole picture is printed.
    uint8_t *classes = calloc((size_t)a->width * (size_t)a->height, 1);
    standard.rgb_lin = standard_lin;
    standard.classes = classes;
    ok = test_lin && standard_lin && classes &&
         dip_meter_add(&meter, &test, test_lin, &standard, &sums);
    if (ok) {
        found->metrics = dip_metrics_of(&sums, 0);
        count_differences(a, b, found);
        ok = !options->map || write_map(options->map, meter.flip_map, a->width, a->height, err);
    } else {
        dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "compare", "out of memory");
    }
    free(classes);
    free(test_lin);
    free(standard_lin);
    dip_meter_free(&meter);
    return ok;
}

// --- output --------------------------------------------------------------------------------------

static void print_text(const CompareOptions *options, const DipPicture *a,
                       const Comparison *found) {
    const double pixels = (double)a->width * a->height;
    dip_put_text(stdout, "%s", options->files[0]);
    if (options->filter) {
        printf(", %s", filter_names[options->filter]);
        if (options->filter - 1 == DIP_POST_SHARPEN) {
            printf(" %g", options->sharpness);
        }
    }
    dip_put_text(stdout, "\nagainst %s, %d x %d pixels, alpha is ignored\n\n", options->files[1],
                 a->width, a->height);
    printf("FLIP       %-10.4f 0 is equal, at %.4g pixels per degree\n", found->metrics.flip,
           options->pixels_per_degree);
    if (isinf(found->metrics.psnr_db)) {
        printf("PSNR       %-10s all codes are equal\n", "infinite");
    } else {
        printf("PSNR       %-10.2f dB, of sRGB codes\n", found->metrics.psnr_db);
    }
    printf("SSIM       %-10.4f 1 is equal\n", found->metrics.ssim);
    printf("RMSE       %-10.4f in linear light, 0..1\n", found->metrics.rmse_lin);
    printf("different  %-10llu pixels, %.2f %%, by at most %d codes of 255\n",
           (unsigned long long)found->other_pixels, 100.0 * (double)found->other_pixels / pixels,
           found->greatest);
    if (found->work.edges_found) {
        printf("edges      %-10llu pixels at which the filter found an edge\n",
               (unsigned long long)found->work.edges_found);
    }
}

static void print_json(const CompareOptions *options, const DipPicture *a,
                       const Comparison *found) {
    printf("{\"picture\": ");
    dip_put_script_string(stdout, options->files[0]);
    printf(", \"standard\": ");
    dip_put_script_string(stdout, options->files[1]);
    printf(", \"filter\": \"%s\", \"width\": %d, \"height\": %d, \"pixels_per_degree\": %.9g",
           filter_names[options->filter], a->width, a->height, options->pixels_per_degree);
    printf(", \"flip\": %.9g, \"psnr_db\": ", found->metrics.flip);
    if (isinf(found->metrics.psnr_db)) { // JSON has no infinity.
        printf("null");
    } else {
        printf("%.9g", found->metrics.psnr_db);
    }
    printf(", \"ssim\": %.9g, \"rmse_lin\": %.9g, \"different_pixels\": %llu, "
           "\"greatest_difference\": %d, \"edges_found\": %llu}\n",
           found->metrics.ssim, found->metrics.rmse_lin, (unsigned long long)found->other_pixels,
           found->greatest, (unsigned long long)found->work.edges_found);
}

// --- command -------------------------------------------------------------------------------------

static bool save(const char *file, const DipPicture *a, DipError *err) {
    return dip_png_write_rgba8(file, a->rgba8, (size_t)a->width * 4, a->width, a->height, err);
}

static bool run_compare(DipSession *session, const void *arguments, DipError *err) {
    (void)session;
    const CompareOptions *options = arguments;
    DipPicture a = {0};
    DipPicture b = {0};
    Comparison found = {0};
    const bool done =
        dip_picture_read_file(options->files[0], &a, err) &&
        dip_picture_read_file(options->files[1], &b, err) && check_sizes(options, &a, &b, err) &&
        (!options->filter || apply_filter(options, &a, b.width, b.height, &found.work, err)) &&
        (!options->save || save(options->save, &a, err)) && measure(options, &a, &b, &found, err);
    if (done && options->json) {
        print_json(options, &a, &found);
    } else if (done) {
        print_text(options, &a, &found);
    }
    dip_picture_free(&a);
    dip_picture_free(&b);
    return done;
}

static void set_defaults(void *options) {
    CompareOptions *compare = options;
    compare->sharpness = 0.5;
    compare->pixels_per_degree = DIP_FLIP_PIXELS_PER_DEGREE;
}

static bool check(const void *options, DipError *err) {
    const CompareOptions *compare = options;
    return compare->file_count == 2 ||
           dip_error_set(err, DIP_ERROR_MISSING, NULL, 0, "compare",
                         "needs two pictures but got %d: compare A B", compare->file_count);
}

#define FIELD(name) offsetof(CompareOptions, name)

static const DipOptionRow rows[] = {
    {"--filter", "NAME", DIP_OPTION_CHOICE, FIELD(filter), .names = filter_names,
     .most = DIP_ARRAY_COUNT(filter_names),
     .accepted = "none, fxaa, smaa, sharpen, bilinear, bicubic or easu",
     .text =
         "Apply this filter to A before it is compared: fxaa or smaa (antialiasing), sharpen, "
         "or bilinear, bicubic or easu, which enlarge A to the size of B. The default is none."},
    {"--sharpness", "X", DIP_OPTION_NUMBER, FIELD(sharpness), .least = 0, .most = 1,
     .text = "How strongly --filter sharpen sharpens: 0 changes nothing, 1 is the strongest. The "
             "default is 0.5."},
    {"--save", "FILE", DIP_OPTION_TEXT, FIELD(save),
     .text = "Write A as a PNG file, after the filter. Alpha is left out."},
    {"--map", "FILE", DIP_OPTION_TEXT, FIELD(map),
     .text = "Write FLIP of each pixel as a PNG file: black is equal, purple, orange and light "
             "yellow differ more and more."},
    {"--json", NULL, DIP_OPTION_FLAG, FIELD(json), .text = "Print the result as one line of JSON."},
};

static const DipOptionTable table = DIP_OPTION_TABLE("What to compare", rows);

static const DipOptionPart parts[] = {
    {&table, 0},
    {&dip_viewing_option_table, FIELD(pixels_per_degree)},
    {&dip_program_option_table, FIELD(program)},
};
static const DipOptionParts all_parts = {parts, DIP_ARRAY_COUNT(parts)};

static const DipExample examples[] = {
    {"diptych compare mine.png truth.png", "prints FLIP, PSNR, SSIM and RMSE"},
    {"diptych compare mine.png truth.png --filter smaa --save smaa.png",
     "antialiases mine.png, writes it and measures it"},
    {"diptych compare half.png truth.png --filter easu --map flip.png",
     "enlarges half.png to the size of truth.png and draws where it differs"},
};

const DipCommand dip_compare_command = {
    .name = "compare",
    .summary = "measure how much two pictures differ, after a filter if one is named",
    .usage = "A B [OPTION]...",
    .text = "Compare reads two pictures of any program and measures how much A differs from B, "
            "with the same measures as cost: FLIP, which follows how the eye sees differences, "
            "PSNR, SSIM, and the root mean square error in linear light. Both are taken as sRGB. "
            "It can first apply one of Diptych's filters to A: antialiasing of a finished "
            "picture, sharpening or enlarging. docs/post.md defines the filters.\n\n"
            "Pictures may be PNG, JPEG, BMP, TGA, DDS, PCX, PPM, PGM or HDR files. Alpha is "
            "ignored, and an HDR file is cut off at 1.",
    .examples = examples,
    .example_count = DIP_ARRAY_COUNT(examples),
    .parts = &all_parts,
    .operands = {.field = FIELD(files), .count = FIELD(file_count), .most = 2},
    .options_size = sizeof(CompareOptions),
    .set_defaults = set_defaults,
    .check = check,
    .run = run_compare,
};
