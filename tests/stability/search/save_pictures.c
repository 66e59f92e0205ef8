// Writes pictures as PPM files.
#include "tests/stability/search/save_pictures.h"

#include <math.h>

static int encode(double linear) {
    const double value = fmin(fmax(linear, 0.0), 1.0);
    const double encoded =
        value <= 0.0031308 ? 12.92 * value : 1.055 * pow(value, 1.0 / 2.4) - 0.055;
    return (int)(255.0 * encoded + 0.5);
}

// Writes a * factor, or |a - b| * factor if b is not NULL.
static bool write_ppm(const char *name, const char *kind, const StabilityPicture *a,
                      const StabilityPicture *b, double factor) {
    char file[512];
    snprintf(file, sizeof file, "%s_%s.ppm", name, kind);
    FILE *out = fopen(file, "wb");
    if (!out) {
        fprintf(stderr, "stability_search: cannot write %s\n", file);
        return false;
    }
    fprintf(out, "P6\n%d %d\n255\n", a->width, a->height);
    for (int i = 0; i < 3 * a->width * a->height; i++) {
        const double value = b ? fabs(a->rgb_lin[i] - b->rgb_lin[i]) : a->rgb_lin[i];
        putc(encode(factor * value), out);
    }
    const bool good = !ferror(out);
    return fclose(out) == 0 && good;
}

bool search_save_pictures(const SearchBench *bench, Choices *choices, const char *name) {
    static SearchScene made;
    choices_rewind(choices);
    search_scene_make(&made, choices);
    StabilityRun run = {.isa = dip_isa_best(), .pool = bench->pool_of_one};
    const StabilityShot shot = search_scene_shot(&made);
    StabilityPicture fast = {0};
    StabilityPicture reference = {0};
    const bool drawn =
        stability_draw(&run, &shot, &fast) && stability_draw_reference(&run, &shot, &reference);
    if (!drawn) {
        fprintf(stderr, "stability_search: %s\n", run.broken_why);
    }
    const bool written = drawn && write_ppm(name, "fast", &fast, NULL, 1.0) &&
                         write_ppm(name, "reference", &reference, NULL, 1.0) &&
                         write_ppm(name, "difference", &fast, &reference, 16.0);
    stability_picture_free(&fast);
    stability_picture_free(&reference);
    dip_test_scene_free(&made.scene);
    return written;
}
