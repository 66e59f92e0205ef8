// A program that answers as `diptych bench --serve` does, with times and counters by formula, so
// that `cost diff` can be tested without a clock. It draws nothing.
//
// The environment variable FAKE is a list of words: `slower` makes every texel take 5 % longer,
// `alike` every frame; `counts` adds a triangle to a frame, `pictures` changes all pictures, and
// `wild` makes frames up to several times as long, at random, as on a machine that is far too busy.
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_SETS = 32 };

// Work of a set of settings, in millions, as in the courtyard.
typedef struct Work {
    double texels;
    double samples;
} Work;

static Work work_of(const char *set) {
    const bool aa8 = strstr(set, "aa=8") != NULL, aa4 = strstr(set, "aa=4") != NULL;
    const bool af = strstr(set, "af=16") != NULL, aaa = strstr(set, "aaa=on") != NULL;
    Work work = {4.9, aa8 ? 2.5 : aa4 ? 1.25 : 0.31};
    work.texels += (aa8 ? 0.7 : 0.0) + (af ? 4.4 : 0.0) + (aaa ? 1.4 : 0.0);
    work.texels += aaa && af ? 3.0 : 0.0;
    work.texels -= strstr(set, "opt=advanced") ? 1.3 : 0.0;
    return work;
}

static unsigned long long state;

static bool has_word(const char *word) {
    const char *words = getenv("FAKE");
    return words && strstr(words, word);
}

// Noise of half a per cent, roughly normal.
static double noise(void) {
    double sum = -6.0;
    for (int i = 0; i < 12; i++) {
        state = state * 6364136223846793005ull + 1442695040888963407ull;
        sum += (double)(state >> 40) * 0x1p-24;
    }
    return has_word("wild") ? 1.0 + 0.5 * fabs(sum) : 1.0 + 0.005 * sum;
}

// Each start has noise of its own, which is the same in every test: the file `seed` counts starts.
static unsigned long long next_seed(void) {
    unsigned long long seed = 0;
    FILE *in = fopen("seed", "r");
    if (in) {
        if (fscanf(in, "%llu", &seed) != 1) {
            seed = 0;
        }
        fclose(in);
    }
    FILE *out = fopen("seed", "w");
    if (out) {
        fprintf(out, "%llu\n", seed + 1);
        fclose(out);
    }
    return seed * 1000003ull + 17ull;
}

static void answer(const Work *work, int frame) {
    const double alike = has_word("alike") ? 1.05 : 1.0;
    const double slow = has_word("slower") ? 0.05 : 0.0;
    const double factor = 1e3 * noise() * alike * (1.0 + 0.1 * frame);
    const double shading = 3.0 + (1.0 + slow) * work->texels;
    const double raster = 1.0 + 2.0 * work->samples;
    printf("geometry_ms=%.9f raster_ms=%.9f shading_ms=%.9f resolve_ms=%.9f total_ms=%.9f ",
           0.5 * factor, raster * factor, shading * factor, 0.1 * factor,
           (0.6 + raster + shading) * factor);
    printf("triangles_in=%d texels_fetched=%.0f samples_shown=%.0f ",
           1000 + (has_word("counts") && frame == 1), 1e6 * work->texels, 1e6 * work->samples);
    printf("hash=%032d\n", has_word("pictures") ? 1 : 2);
    fflush(stdout);
}

static const char *value_of(int argc, char **argv, const char *name) {
    for (int i = 1; i + 1 < argc; i++) {
        if (strcmp(argv[i], name) == 0) {
            return argv[i + 1];
        }
    }
    return "";
}

int main(int argc, char **argv) {
    Work works[MOST_SETS];
    char sets[4096], line[256];
    int count = 0, set, frame, hash;
    state = next_seed();
    snprintf(sets, sizeof sets, "%s", value_of(argc, argv, "--sets"));
    for (char *text = strtok(sets, ";"); text && count < MOST_SETS; text = strtok(NULL, ";")) {
        works[count++] = work_of(text);
    }
    printf("diptych-bench 1 %d %s\n", count, value_of(argc, argv, "--frames"));
    fflush(stdout);
    while (fgets(line, sizeof line, stdin) &&
           sscanf(line, "draw %d %d %d", &set, &frame, &hash) == 3) {
        answer(&works[set], frame);
    }
    return 0;
}
