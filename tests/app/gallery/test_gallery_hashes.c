// Draws every scene of the gallery with every look, in several settings, with every instruction set
// and with one and three threads. The hashes of all pictures must equal those of a list, which the
// gcc and clang builds share, and the counters of work must not differ. The list must not hold
// hashes of pictures that nobody draws any more.
//
// Usage: test_gallery_hashes ASSETS LIST [--write] [--scene NAME] [--half N]. --write creates the
// list with the scalar kernels on one thread. --scene draws one scene only. --half 0 and --half 1
// draw each instruction set with one of both thread counts, in turns; together they draw
// everything.
#include "app/gallery/gallery.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { WIDTH = 200, HEIGHT = 150, MAX_PICTURES = 1000, TIMES = 2 };

static const char *const settings[] = {"aa=none", "aa=4,af=16,aaf=on", "aa=8,taa=on,opt=advanced",
                                       "aa=6,aaa=on,asd=2,af=4,miplod=performance",
                                       "aa=2,mipdebug=on"};
enum { SETTINGS = sizeof settings / sizeof *settings };
static const int64_t times_ns[TIMES] = {1300000000, 9700000000};

typedef struct Picture {
    char name[96]; // scene, look, settings and time
    char hash[33];
    DipCounters work;
} Picture;

static bool fail(const char *what, const DipError *err) {
    char text[512] = "";
    if (err) {
        dip_error_format(err, text, sizeof text);
    }
    fprintf(stderr, "%s %s\n", what, text);
    return false;
}

static bool draw_look(DipGallery *gallery, DipGalleryPane *pane, int scene, int look,
                      Picture *pictures, int *count, DipError *err) {
    dip_gallery_set_look(gallery, look);
    for (int s = 0; s < SETTINGS; s++) {
        DipQuality quality;
        if (!dip_quality_parse(settings[s], &quality, err) ||
            !dip_gallery_pane_set_quality(pane, &quality, err)) {
            return false;
        }
        for (int t = 0; t < TIMES; t++) {
            DipPose pose;
            DipFrame frame;
            Picture *picture = &pictures[(*count)++];
            dip_gallery_pose(scene, times_ns[t], &pose);
            dip_gallery_pane_set_frame_index(pane, (uint64_t)t);
            if (!dip_gallery_pane_draw(pane, &pose, times_ns[t], &frame, err)) {
                return false;
            }
            snprintf(picture->name, sizeof picture->name, "%s.%d %s %d",
                     dip_gallery_info(scene)->name, look, settings[s], t);
            dip_frame_hash(&frame, picture->hash);
            picture->work = frame.counters;
        }
    }
    return true;
}

static bool draw_scene(const char *assets, int scene, DipPool *pool, DipIsa isa, Picture *pictures,
                       int *count) {
    DipError err = {0};
    const DipGalleryDef def = {scene, pool, isa, assets};
    DipGallery *gallery = dip_gallery_create(&def, &err);
    const DipGalleryPaneDef pane_def = {gallery, isa, WIDTH, HEIGHT, dip_quality_default()};
    DipGalleryPane *pane = gallery ? dip_gallery_pane_create(&pane_def, &err) : NULL;
    bool drawn = pane != NULL;
    for (int look = 0; drawn && look < dip_gallery_info(scene)->look_count; look++) {
        drawn = draw_look(gallery, pane, scene, look, pictures, count, &err);
    }
    dip_gallery_pane_destroy(&pane);
    dip_gallery_destroy(&gallery);
    return drawn || fail(dip_gallery_info(scene)->name, &err);
}

// Returns the number of pictures, or -1.
static int draw_all(const char *assets, int only, DipIsa isa, int threads, Picture *pictures) {
    DipError err = {0};
    int count = 0;
    DipPool *pool = dip_pool_create(threads, &err);
    bool drawn = pool || fail("no threads:", &err);
    for (int scene = 0; drawn && scene < dip_gallery_scene_count(); scene++) {
        if (only < 0 || only == scene) {
            drawn = draw_scene(assets, scene, pool, isa, pictures, &count);
        }
    }
    dip_pool_destroy(&pool);
    return drawn ? count : -1;
}

static bool write_list(const char *file, const Picture *pictures, int count) {
    FILE *list = fopen(file, "w");
    for (int i = 0; list && i < count; i++) {
        fprintf(list, "%s %s\n", pictures[i].name, pictures[i].hash);
    }
    return (list && fclose(list) == 0) || fail("cannot write the list", NULL);
}

// Finds a picture's hash in the text of the list.
static bool is_listed(const char *text, const Picture *picture) {
    char line[160];
    snprintf(line, sizeof line, "%s %s\n", picture->name, picture->hash);
    return strstr(text, line) != NULL;
}

static int compare(const char *text, const Picture *first, const Picture *found, int count,
                   DipIsa isa, int threads) {
    int differences = 0;
    for (int i = 0; i < count; i++) {
        const bool same_work = memcmp(&first[i].work, &found[i].work, sizeof first[i].work) == 0;
        if ((!is_listed(text, &found[i]) || !same_work) && differences++ < 10) {
            fprintf(stderr, "%s, %d threads: %s: %s %s\n", dip_isa_name(isa), threads,
                    found[i].name, found[i].hash,
                    same_work ? "is not the picture of the list" : "took other work");
        }
    }
    printf("%-7s %d threads: %d pictures, %d differ\n", dip_isa_name(isa), threads, count,
           differences);
    fflush(stdout);
    return differences;
}

// Returns the number of lines of the list that are not the line of a picture. Lists the first ten.
static int count_retired(const char *text, const Picture *pictures, int count) {
    int retired = 0;
    for (const char *line = text; *line; line += strcspn(line, "\n"), line += *line == '\n') {
        const size_t length = strcspn(line, "\n");
        bool drawn = false;
        for (int i = 0; i < count && !drawn; i++) {
            char expected[160];
            const int size =
                snprintf(expected, sizeof expected, "%s %s", pictures[i].name, pictures[i].hash);
            drawn = (size_t)size == length && strncmp(line, expected, length) == 0;
        }
        if (!drawn && retired++ < 10) {
            fprintf(stderr, "the list has a picture that is not drawn: %.*s\n", (int)length, line);
        }
    }
    return retired;
}

static char *read_text(const char *file) {
    FILE *in = fopen(file, "rb");
    char *text = calloc(1, 1 << 20);
    if (in && text) {
        text[fread(text, 1, (1 << 20) - 1, in)] = '\0';
    }
    if (in) {
        fclose(in);
    }
    return text;
}

int main(int argc, char **argv) {
    static Picture first[MAX_PICTURES];
    static Picture found[MAX_PICTURES];
    int only = -1;
    int half = -1;
    bool write = false;
    for (int i = 3; i < argc; i++) {
        if (strcmp(argv[i], "--write") == 0) {
            write = true;
        } else if (strcmp(argv[i], "--scene") == 0 && i + 1 < argc) {
            if (!dip_gallery_find(argv[++i], &only, NULL)) {
                return 2;
            }
        } else if (strcmp(argv[i], "--half") == 0 && i + 1 < argc) {
            half = atoi(argv[++i]);
        }
    }
    if (argc < 3) {
        fprintf(stderr,
                "usage: test_gallery_hashes ASSETS LIST [--write] [--scene NAME] [--half N]\n");
        return 2;
    }
    const int first_threads = half == 1 ? 3 : 1;
    const int count = draw_all(argv[1], only, DIP_ISA_SCALAR, first_threads, first);
    if (count < 0 || write) {
        return count < 0 || !write_list(argv[2], first, count);
    }
    char *text = read_text(argv[2]);
    int differences = compare(text, first, first, count, DIP_ISA_SCALAR, first_threads);
    for (int isa = 0; isa < DIP_ISA_COUNT; isa++) {
        for (int threads = 1; threads <= 3 && dip_isa_available((DipIsa)isa); threads += 2) {
            const bool drawn = isa == DIP_ISA_SCALAR && threads == first_threads;
            if (drawn || half == (isa + threads / 2 + 1) % 2) {
                continue;
            }
            if (draw_all(argv[1], only, (DipIsa)isa, threads, found) != count) {
                return 1;
            }
            differences += compare(text, first, found, count, (DipIsa)isa, threads);
        }
    }
    const int retired = only < 0 ? count_retired(text, first, count) : 0;
    free(text);
    return differences != 0 || retired != 0;
}
