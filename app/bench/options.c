// Describes, reads and checks the options of `diptych bench`.
#include "app/bench/options.h"

#include "app/bench/synthetic.h"
#include "renderer/base/assert.h"
#include "renderer/base/pool.h"

#include <errno.h>
#include <string.h>
#include <unistd.h>

#define FIELD(name) offsetof(DipBenchOptions, name)
#define COUNT(AXIS) FIELD(counts[DIP_BENCH_AXIS_##AXIS])

static const char default_sets[] = "aa=none;aa=4;aa=8;af=16;aa=4,af=16;aa=8,af=16";

// --- the values of lists -------------------------------------------------------------------------

static bool read_isa(void *fields, const DipOptionRow *row, const char *value, DipError *err) {
    DipBenchOptions *bench = fields;
    return dip_option_isa(row, value, &bench->isas[bench->counts[DIP_BENCH_AXIS_ISA]], err);
}

// --- the tables ----------------------------------------------------------------------------------

static const DipOptionRow axis_rows[] = {
    {"--sets", "LIST", DIP_OPTION_LIST, FIELD(sets), .count = COUNT(SET),
     .room = DIP_BENCH_MAX_VALUES, .separator = ';', .item = DIP_OPTION_SET,
     .text = "Settings to measure, as SET;SET;... in quotes. The default is aa=none, aa=4 and "
             "aa=8, each without and with af=16."},
    {"--size", "LIST", DIP_OPTION_LIST, FIELD(sizes), .count = COUNT(SIZE),
     .room = DIP_BENCH_MAX_VALUES, .separator = ',', .item = DIP_OPTION_SIZE,
     .text = "Sizes of the picture in pixels, as WxH,WxH,... Without the option, the ini's RES "
             "decides."},
    {"--scale", "LIST", DIP_OPTION_LIST, FIELD(scales), .count = COUNT(SCALE),
     .room = DIP_BENCH_MAX_VALUES, .separator = ',', .item = DIP_OPTION_NUMBER, .least = 0.1,
     .most = 1.0, .accepted = "a share of the width and height from 0.1 to 1",
     .text = "Render scales, such as 0.5,1, from 0.1 to 1. The picture is drawn with this share of "
             "its width and height, and enlarged to its size within the measured time."},
    {"--threads", "LIST", DIP_OPTION_LIST, FIELD(threads), .count = COUNT(THREADS),
     .room = DIP_BENCH_MAX_VALUES, .separator = ',', .item = DIP_OPTION_INTEGER,
     .most = DIP_MAX_THREADS,
     .text = "Numbers of threads, such as 1,2. 0 stands for all processors. Without the option, "
             "the ini decides."},
    {"--isa", "LIST", DIP_OPTION_LIST, .count = COUNT(ISA), .room = DIP_BENCH_MAX_VALUES,
     .separator = ',', .read = read_isa,
     .text =
         "Instruction sets, such as sse2,avx2: any of auto, scalar, sse2, avx2 and avx512. Without "
         "the option, the ini's ISA decides; its default is the best one of this machine."},
    {"--grid", "LIST", DIP_OPTION_LIST, FIELD(grids), .count = COUNT(GRID),
     .room = DIP_BENCH_MAX_VALUES, .separator = ',', .item = DIP_OPTION_INTEGER, .least = 2,
     .most = DIP_SYNTHETIC_MAX_TRIANGLES,
     .text =
         "Instead of a scene, draw grids with these numbers of triangles. A grid is a wavy surface "
         "that fills the picture."},
    {"--grid-out-of-view", NULL, DIP_OPTION_FLAG, FIELD(grid_out_of_view),
     .text = "Turn the camera away from the grid. This measures the cost of triangles that are out "
             "of view."},
};

static const DipOptionRow measure_rows[] = {
    {"--frames", "N", DIP_OPTION_INTEGER, FIELD(frames), .least = 1, .most = DIP_BENCH_MAX_FRAMES,
     .text = "Draw this many frames, which divide the camera path evenly. The default is 12."},
    {"--vs", "PROGRAM", DIP_OPTION_TEXT, FIELD(vs),
     .text = "Compare this program with another build of diptych. The two draw in turn, and the "
             "bench prints the other program's times divided by this program's times."},
    {"--csv", "FILE", DIP_OPTION_TEXT, FIELD(csv),
     .text = "Write the times and counters of every frame of every round to this file."},
    {"--svg", "DIR", DIP_OPTION_TEXT, FIELD(svg),
     .text =
         "Write plots into this folder. They show the time against the number of pixels, samples, "
         "triangles or threads, or the render scale. There is one plot for each that varies."},
};

static const DipOptionTable axis_table = DIP_OPTION_TABLE("Lists of values", axis_rows);
static const DipOptionTable measure_table = DIP_OPTION_TABLE("Measuring and output", measure_rows);

static const DipOptionPart parts[] = {
    {&axis_table, offsetof(DipBenchArguments, bench)},
    {&measure_table, offsetof(DipBenchArguments, bench)},
    {&dip_measure_option_table, offsetof(DipBenchArguments, bench.measure)},
    {&dip_serve_option_table, offsetof(DipBenchArguments, bench.serve)},
    {&dip_scene_option_table, offsetof(DipBenchArguments, session)},
    {&dip_path_option_table, offsetof(DipBenchArguments, session)},
    {&dip_category_option_table, offsetof(DipBenchArguments, session)},
    {&dip_camera_option_table, offsetof(DipBenchArguments, session)},
    {&dip_program_option_table, offsetof(DipBenchArguments, program)},
};
const DipOptionParts dip_bench_option_parts = {parts, DIP_ARRAY_COUNT(parts)};

// --- defaults and checks -------------------------------------------------------------------------

void dip_bench_options_default(void *arguments) {
    DipBenchOptions *bench = &((DipBenchArguments *)arguments)->bench;
    bench->frames = 12;
    bench->measure.rounds = 10;
    dip_option_store(&axis_rows[0], default_sets, bench, NULL);
}

static bool varies_in_samples(const DipBenchOptions *bench) {
    for (int i = 1; i < bench->counts[DIP_BENCH_AXIS_SET]; i++) {
        if (dip_quality_sample_count(&bench->sets[i].quality) !=
            dip_quality_sample_count(&bench->sets[0].quality)) {
            return true;
        }
    }
    return false;
}

static bool check_scene(const DipBenchArguments *arguments, DipError *err) {
    const DipSessionOptions *session = &arguments->session;
    if (arguments->bench.counts[DIP_BENCH_AXIS_GRID] &&
        (session->model_count || session->scene || session->path || session->category ||
         session->has_pose)) {
        return dip_error_set(err, DIP_ERROR_CONFLICT, NULL, 0, "--grid",
                             "a grid replaces the scene and its path; leave out --grid or %s",
                             session->model_count ? "--model"
                             : session->scene     ? "--scene"
                             : session->path      ? "--path"
                             : session->category  ? "--category"
                                                  : "--pose");
    }
    return dip_session_options_check(session, err);
}

static bool check_plots(const DipBenchOptions *bench, DipError *err) {
    bool varies = varies_in_samples(bench);
    for (int axis = 0; axis < DIP_BENCH_AXIS_COUNT; axis++) {
        varies = varies || (bench->counts[axis] > 1 && axis != DIP_BENCH_AXIS_SET &&
                            axis != DIP_BENCH_AXIS_ISA);
    }
    if (bench->svg && !varies) {
        return dip_error_set(err, DIP_ERROR_MISSING, NULL, 0, "--svg",
                             "there is nothing to plot; give more than one value of --size, "
                             "--scale, --grid, --threads, or of aa in --sets");
    }
    return !bench->svg || !bench->vs ||
           dip_error_set(err, DIP_ERROR_CONFLICT, NULL, 0, "--svg",
                         "plots show one program; leave out --svg or --vs");
}

bool dip_bench_options_check(const void *arguments, DipError *err) {
    const DipBenchOptions *bench = &((const DipBenchArguments *)arguments)->bench;
    int count = 1;
    for (int axis = 0; axis < DIP_BENCH_AXIS_COUNT; axis++) {
        count *= bench->counts[axis] ? bench->counts[axis] : 1;
    }
    if (count > DIP_BENCH_MAX_COMBINATIONS) {
        return dip_error_set(err, DIP_ERROR_RANGE, NULL, 0, "bench",
                             "the lists make %d combinations; give values for at most %d", count,
                             DIP_BENCH_MAX_COMBINATIONS);
    }
    if (bench->measure.rounds > DIP_BENCH_MAX_ROUNDS) {
        return dip_error_set(err, DIP_ERROR_RANGE, NULL, 0, "--rounds",
                             "the bench has at most %d rounds; give more --frames",
                             DIP_BENCH_MAX_ROUNDS);
    }
    if (bench->grid_out_of_view && !bench->counts[DIP_BENCH_AXIS_GRID]) {
        return dip_error_set(err, DIP_ERROR_MISSING, NULL, 0, "--grid-out-of-view",
                             "there is no grid; give one with --grid N,N,...");
    }
    if (bench->vs && !bench->serve && access(bench->vs, X_OK) != 0) {
        return dip_error_set(err, DIP_ERROR_IO, bench->vs, 0, "--vs", "cannot be run: %s",
                             strerror(errno));
    }
    return check_plots(bench, err) && check_scene(arguments, err);
}
