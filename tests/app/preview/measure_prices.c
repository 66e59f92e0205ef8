// Measures rough prices as the preview does, without a window, for scripts:
//
//     measure_prices INI WIDTH HEIGHT THREADS POSES PATH
//
// Standard input asks for prices, one per line (price_lines.h). The program rests at as many poses
// as it is told, spread evenly along the path of this name in the ini, such as DEFAULT or AF. At
// each pose it measures with every line's settings in the requested pane, and answers all lines.
#include "app/preview/live/live_prices.h"
#include "tests/app/preview/price_lines.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_LINES = 256 };

static char lines[MOST_LINES][512];
static int line_count;

static int fail(const char *why) {
    fprintf(stderr, "measure_prices: %s\n", why);
    return 2;
}

static bool read_lines(void) {
    while (line_count < MOST_LINES && fgets(lines[line_count], sizeof lines[0], stdin)) {
        line_count++;
    }
    return line_count > 0;
}

// Measures all that a pane with the settings of a line needs.
static void rest(DipLivePrices *live, const DipLivePicture *picture, const char *line) {
    DipQuality panes[DIP_PANE_COUNT] = {dip_quality_default(), dip_quality_default()};
    const char *settings = strrchr(line, ' ');
    char text[256] = "";
    if (settings) {
        sscanf(settings, " %255s", text);
    }
    dip_quality_parse(text, &panes[DIP_PANE_REQUESTED], NULL);
    do {
        dip_live_prices_step(live, picture, panes, &(DipLiveTruth){.samples = 0}, 8.0);
    } while (dip_live_prices_are_working(live));
}

static bool answer_at(DipLivePrices *live, const DipPrices *prices, const DipLivePicture *picture) {
    for (int i = 0; i < line_count; i++) {
        rest(live, picture, lines[i]);
    }
    for (int i = 0; i < line_count; i++) {
        if (!dip_print_price(prices, lines[i])) {
            return false;
        }
    }
    fflush(stdout);
    return true;
}

static bool answer_along_path(DipSession *session, int poses) {
    DipPrices *prices = dip_prices_create(NULL);
    DipLivePrices *live = prices ? dip_live_prices_create(session, prices, NULL) : NULL;
    const DipCamPath *path = session->track.categories[session->track.active].path;
    const int64_t duration_ns = dip_campath_info(path).duration_ns;
    bool done = live != NULL;
    for (int i = 0; done && i < poses; i++) {
        DipLivePicture picture = {.time_ns = duration_ns / (2 * poses) * (2 * i + 1),
                                  .width = session->pane_size.width,
                                  .height = session->pane_size.height};
        done = dip_camtrack_pose(&session->track, picture.time_ns, &picture.pose) &&
               answer_at(live, prices, &picture);
    }
    dip_live_prices_destroy(&live);
    dip_prices_destroy(&prices);
    return done;
}

int main(int argc, char **argv) {
    if (argc != 7 || !read_lines()) {
        return fail("give INI WIDTH HEIGHT THREADS POSES PATH and at least one line");
    }
    const DipSessionOptions options = {
        .config = argv[1],
        .category = argv[6],
        .has_size = true,
        .size = {atoi(argv[2]), atoi(argv[3])},
        .has_threads = true,
        .threads = atoi(argv[4]),
    };
    const DipSessionDef def = {.options = &options, .scene = true};
    DipSession session;
    DipErrorList faults = {0};
    if (!dip_session_open(&session, &def, &faults)) {
        return fail("the session cannot be opened");
    }
    const bool done = answer_along_path(&session, atoi(argv[5]));
    dip_session_close(&session);
    dip_error_list_free(&faults);
    return done ? 0 : fail("a line asks for nothing, or memory ran out");
}
