// Prints the table and writes the CSV file.
#include "tests/peer/table.h"

#include "app/cli/machine.h"
#include "app/measure/stats/rounds.h"

#include <commit.h>
#include <errno.h>
#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

// --- heading -----------------------------------------------------------------------------------

void dip_table_print_heading(FILE *out, const DipPeerOptions *options, const DipPeerScene *scene,
                             const DipPeer *peer) {
    char processor[128];
    dip_machine_processor(processor, sizeof processor);
    fprintf(out, "scene    %s, %" PRIu64 " triangles, %dx%d, %d frames", scene->name,
            scene->triangle_count, options->width, options->height, options->frames);
    if (!options->check) {
        fprintf(out, ", %d rounds", options->rounds);
    }
    fprintf(out, "\nmachine  %s, %d threads each\n", processor, options->threads);
    fprintf(out, "ours     Diptych at commit %s, %s\n", DIP_PEER_COMMIT,
            dip_isa_name(options->isa));
    fprintf(out, "peer     %s, %s\n\n", dip_peer_renderer(peer), dip_peer_version(peer));
}

// --- rows --------------------------------------------------------------------------------------

// A frame of the peer counts as pathological if its time is at least 10 times the peer's median
// time.
static const double PATHOLOGICAL = 10.0;

// With 4 samples and AF, llvmpipe is known to have pathological (extremely slow) frames. These rows
// are printed below the others.
static bool stands_apart(const DipPeerRow *row) {
    return row->sample_count > 1 && row->max_anisotropy > 1 && dip_peer_row_has_peer(row);
}

static void print_decibels(FILE *out, const DipPeerMeasurement *m) {
    if (!dip_peer_row_has_peer(m->row)) {
        fprintf(out, "       -");
    } else if (isinf(m->psnr_db)) {
        fprintf(out, "   equal");
    } else {
        fprintf(out, "  %6.1f  (%.1f in frame %d)", m->psnr_db, m->worst_psnr_db, m->worst_frame);
    }
    fprintf(out, "\n");
}

// Estimates how many times as long as ours the peer takes. Both took turns at every frame.
static DipEstimate ratio_of(const DipPeerMeasurement *m) {
    static const int base_of[2] = {0};
    const int count = m->frames * m->rounds;
    DipEstimate ratio = dip_estimate_unknown(NAN);
    DipTimed *list = malloc(2 * (size_t)count * sizeof *list);
    for (int i = 0; list && i < 2 * count; i++) {
        list[i] = (DipTimed){.subject = i % 2,
                             .round = i / 2 / m->frames,
                             .frame = i / 2 % m->frames,
                             .ms = i % 2 ? m->peer_ms[i / 2] : m->ours_ms[i / 2]};
    }
    const DipTimes times = {list, 2 * count, 2, 1, m->rounds, m->frames, base_of, true};
    DipTimesFit *fit = list ? dip_times_fit(&times, NULL) : NULL;
    if (fit) {
        ratio = dip_times_ratio(fit, 1);
    }
    dip_times_fit_free(&fit);
    free(list);
    return ratio;
}

static void print_row(FILE *out, const DipPeerMeasurement *m, double *scratch) {
    const int count = m->frames * m->rounds;
    fprintf(out, "%-9s", m->row->name);
    if (count) {
        const double ours = dip_percentile_of(m->ours_ms, count, 0.5, scratch);
        const double ours_p95 = dip_percentile_of(m->ours_ms, count, 0.95, scratch);
        if (dip_peer_row_has_peer(m->row)) {
            const double peer = dip_percentile_of(m->peer_ms, count, 0.5, scratch);
            const double peer_p95 = dip_percentile_of(m->peer_ms, count, 0.95, scratch);
            const DipEstimate ratio = ratio_of(m);
            fprintf(out, "%8.2f %8.2f  %8.2f %8.2f  %6.2fx  %5.2f to %5.2f", peer, peer_p95, ours,
                    ours_p95, ratio.value, ratio.low, ratio.high);
        } else {
            fprintf(out, "%8s %8s  %8.2f %8.2f  %7s  %14s", "-", "-", ours, ours_p95, "-", "-");
        }
    }
    print_decibels(out, m);
}

// Prints a note if the peer has pathological frames. They distort its mean, so the note shows the
// mean and the slowest frame.
static void print_note(FILE *out, const DipPeerMeasurement *m, double *scratch) {
    const int count = m->frames * m->rounds;
    if (!count || !dip_peer_row_has_peer(m->row)) {
        return;
    }
    const double median = dip_percentile_of(m->peer_ms, count, 0.5, scratch);
    const double slowest = dip_percentile_of(m->peer_ms, count, 1.0, scratch);
    double sum = 0.0;
    for (int i = 0; i < count; i++) {
        sum += m->peer_ms[i];
    }
    if (slowest > PATHOLOGICAL * median) {
        fprintf(out, "           note: the peer's mean is %.0f ms, its slowest frame %.0f ms\n",
                sum / count, slowest);
    }
}

static double *allocate_scratch(const DipPeerMeasurement *measurements, int count, DipError *err) {
    const size_t most = count ? (size_t)measurements->frames * (size_t)measurements->rounds : 0;
    double *scratch = malloc((most + 1) * sizeof *scratch);
    if (!scratch) {
        dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "--frames", "out of memory");
    }
    return scratch;
}

bool dip_table_print(FILE *out, const DipPeerMeasurement *measurements, int count, DipError *err) {
    double *scratch = allocate_scratch(measurements, count, err);
    if (!scratch) {
        return false;
    }
    if (count && measurements->rounds) {
        fprintf(out, "%-9s%8s %8s  %8s %8s  %7s  %14s  %6s\n", "ms/frame", "peer", "p95", "ours",
                "p95", "ratio", "95 % interval", "PSNR dB");
    } else {
        fprintf(out, "%-9s  %6s\n", "", "PSNR dB");
    }
    for (int i = 0; i < 2 * count; i++) {
        const DipPeerMeasurement *m = &measurements[i % count];
        if (stands_apart(m->row) == (i >= count)) {
            print_row(out, m, scratch);
            print_note(out, m, scratch);
        }
    }
    free(scratch);
    return true;
}

bool dip_table_print_triangles(FILE *out, const DipPeerMeasurement *measurements, int count,
                               uint64_t triangle_count, DipError *err) {
    double *scratch = allocate_scratch(measurements, count, err);
    if (!scratch) {
        return false;
    }
    fprintf(out, "\n%-9s%8s %8s   millions of triangles a second\n", "", "peer", "ours");
    for (int i = 0; i < count; i++) {
        const DipPeerMeasurement *m = &measurements[i];
        const int values = m->frames * m->rounds;
        const double millions_ms = 1e-3 * (double)triangle_count;
        fprintf(out, "%-9s", m->row->name);
        if (dip_peer_row_has_peer(m->row)) {
            fprintf(out, "%8.2f",
                    millions_ms / dip_percentile_of(m->peer_ms, values, 0.5, scratch));
        } else {
            fprintf(out, "%8s", "-");
        }
        fprintf(out, " %8.2f\n", millions_ms / dip_percentile_of(m->ours_ms, values, 0.5, scratch));
    }
    free(scratch);
    return true;
}

// --- other forms -------------------------------------------------------------------------------

bool dip_table_write_csv(const char *file, const DipPeerMeasurement *measurements, int count,
                         DipError *err) {
    FILE *out = fopen(file, "w");
    bool written = out && fprintf(out, "row,frame,round,peer_ms,ours_ms\n") > 0;
    for (int i = 0; written && i < count; i++) {
        const DipPeerMeasurement *m = &measurements[i];
        for (int v = 0; written && v < m->frames * m->rounds; v++) {
            char peer[32] = "";
            if (dip_peer_row_has_peer(m->row)) {
                snprintf(peer, sizeof peer, "%.4f", m->peer_ms[v]);
            }
            written = fprintf(out, "%s,%d,%d,%s,%.4f\n", m->row->name, v % m->frames, v / m->frames,
                              peer, m->ours_ms[v]) > 0;
        }
    }
    if (out && fclose(out) != 0) {
        written = false;
    }
    return written || dip_error_set(err, DIP_ERROR_IO, file, 0, "--csv", "%s", strerror(errno));
}

bool dip_table_append(const char *file, const DipPeerOptions *options, const DipPeerScene *scene,
                      const DipPeer *peer, const DipPeerMeasurement *measurements, int count,
                      DipError *err) {
    char processor[128];
    double *scratch = allocate_scratch(measurements, count, err);
    if (!scratch) {
        return false;
    }
    dip_machine_processor(processor, sizeof processor);
    FILE *out = fopen(file, "a");
    bool written = out != NULL;
    for (int i = 0; written && i < count; i++) {
        const DipPeerMeasurement *m = &measurements[i];
        const int values = m->frames * m->rounds;
        if (!dip_peer_row_has_peer(m->row)) {
            continue;
        }
        const DipEstimate ratio = ratio_of(m);
        written =
            fprintf(out, "%s\t%s\t%" PRIu64 "\t%dx%d\t%s\t", options->label, scene->name,
                    scene->triangle_count, options->width, options->height, m->row->name) > 0 &&
            fprintf(out, "%.3f\t%.3f\t%.3f\t%.3f\t%.3f\t%.1f\t",
                    dip_percentile_of(m->peer_ms, values, 0.5, scratch),
                    dip_percentile_of(m->ours_ms, values, 0.5, scratch), ratio.value, ratio.low,
                    ratio.high, m->psnr_db) > 0 &&
            fprintf(out, "%s, %s\t%s\t%s\t%d\t%s\n", dip_peer_renderer(peer),
                    dip_peer_version(peer), DIP_PEER_COMMIT, dip_isa_name(options->isa),
                    options->threads, processor) > 0;
    }
    if (out && fclose(out) != 0) {
        written = false;
    }
    free(scratch);
    return written || dip_error_set(err, DIP_ERROR_IO, file, 0, "--append", "%s", strerror(errno));
}

double dip_table_lowest_psnr_db(const DipPeerMeasurement *measurements, int count) {
    double lowest = INFINITY;
    for (int i = 0; i < count; i++) {
        const DipPeerRow *row = measurements[i].row;
        if (dip_peer_rows_alike() >> (row - dip_peer_rows) & 1) {
            lowest = fmin(lowest, measurements[i].psnr_db);
        }
    }
    return lowest;
}
