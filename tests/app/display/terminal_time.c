// Tells how much processor time the terminal's display needs for a frame, and how many frames a
// second reach the terminal. Run it in the terminal to measure, and see docs/terminal.md.
//
// Usage: terminal_time FRAMES.rgb WIDTH HEIGHT REPORT.txt
// FRAMES.rgb: frames of WIDTH x HEIGHT pixels, 3 bytes each, as `diptych dump --raw` writes them.
// The frames play at 15 a second; the report then has one line.
#include "app/display/terminal/terminal_display.h"
#include "renderer/base/clock.h"

#include <stdio.h>
#include <stdlib.h>
#include <time.h>

enum { FRAMES_PER_S = 15, MAX_FRAMES = 4096 };

static double cpu_ms(void) {
    struct timespec time;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return 1e3 * (double)time.tv_sec + 1e-6 * (double)time.tv_nsec;
}

// Reads the next frame as RGBA. Returns false at the end of the file.
static bool read_frame(FILE *in, uint8_t *rgba8, int pixels) {
    for (int i = 0; i < pixels; ++i) {
        if (fread(rgba8 + 4 * (size_t)i, 1, 3, in) != 3) {
            return false;
        }
        rgba8[4 * (size_t)i + 3] = 255;
    }
    return true;
}

static void wait_until(int64_t due_ns) {
    const int64_t left_ns = due_ns - dip_clock_ns();
    if (left_ns > 0) {
        const struct timespec time = {left_ns / 1000000000, left_ns % 1000000000};
        nanosleep(&time, NULL);
    }
}

static int by_size(const void *a, const void *b) {
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

int main(int argc, char **argv) {
    static double ms[MAX_FRAMES];
    DipDisplay display;
    DipError err;
    FILE *in = argc == 5 ? fopen(argv[1], "rb") : NULL;
    FILE *report = argc == 5 ? fopen(argv[4], "w") : NULL;
    if (!in || !report) {
        fprintf(stderr, "usage: terminal_time FRAMES.rgb WIDTH HEIGHT REPORT.txt\n");
        return 2;
    }
    const int width = atoi(argv[2]), height = atoi(argv[3]);
    uint8_t *pixels = malloc(4 * (size_t)width * (size_t)height);
    const DipPixels picture = {pixels, 4 * (size_t)width, width, height};
    const DipRect all = {0, 0, width, height};
    if (!pixels || !dip_terminal_display_open(&display, DIP_TERMINAL_AUTO, &err)) {
        fprintf(stderr, "terminal_time: %s\n", pixels ? err.message : "out of memory");
        return 1;
    }
    const int64_t begin_ns = dip_clock_ns();
    int count = 0;
    while (count < MAX_FRAMES && read_frame(in, pixels, width * height)) {
        const double begin_ms = cpu_ms();
        if (!display.present(display.context, &picture, &all, 1, &err)) {
            break;
        }
        ms[count++] = cpu_ms() - begin_ms;
        wait_until(begin_ns + count * INT64_C(1000000000) / FRAMES_PER_S);
    }
    const double seconds = 1e-9 * (double)(dip_clock_ns() - begin_ns);
    display.close(display.context);
    qsort(ms, (size_t)count, sizeof ms[0], by_size);
    fprintf(report,
            "%d frames of %dx%d pixels, %.1f a second, CPU per frame: median %.2f ms, 95 %% within "
            "%.2f ms\n",
            count, width, height, count / seconds, count ? ms[count / 2] : 0.0,
            count ? ms[count * 95 / 100] : 0.0);
    fclose(report);
    fclose(in);
    free(pixels);
    return 0;
}
