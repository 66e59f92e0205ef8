// Lists the fields of visits, which hold every timed frame.
#include "app/report/format/cost_fields_private.h"

#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

// A file may have at most this many measured times for each row and frame of a path, on average.
// Real reports have fewer. A frame has several measured times if its row was timed again for
// advice, or if the row is a baseline, whose frames are timed in every block
// (app/measure/timing/driver.h).
enum { MOST_TIMES = 64 };

// A visit (app/measure/timing/driver.h): successive frames of the log that have the same row,
// start, round and block.
typedef struct Visit {
    int row;
    int start;
    int round;
    int block;
    double begin_ms;
    DipTimed *frames; // Part of the log.
    int count;
} Visit;

static bool is_same_visit(const DipTimed *a, const DipTimed *b) {
    return a->subject == b->subject && a->start == b->start && a->round == b->round &&
           a->block == b->block;
}

static int count_visits(const DipFieldAt *at) {
    const DipCostReport *report = dip_cost_report_of(at);
    int count = 0;
    for (int i = 0; i < report->log_count; i++) {
        count += i == 0 || !is_same_visit(&report->log[i - 1], &report->log[i]);
    }
    return count;
}

// Makes a visit from the log. It begins where the previous visit ends, which *scratch still holds.
static const void *get_visit(const DipFieldAt *at, int index, DipFieldScratch *scratch) {
    const DipCostReport *report = dip_cost_report_of(at);
    Visit *visit = (Visit *)scratch;
    DipTimed *first = index > 0 ? visit->frames + visit->count : report->log;
    *visit = (Visit){.row = first->subject,
                     .start = first->start,
                     .round = first->round,
                     .block = first->block,
                     .begin_ms = (double)first->begin_ns / 1e6,
                     .frames = first};
    const int most = report->log_count - (int)(first - report->log);
    while (visit->count < most && is_same_visit(first, &first[visit->count])) {
        visit->count++;
    }
    return visit;
}

// Refuses visits if the number of starts is missing or does not divide the number of rounds.
// Accepts an empty list, since older files have pairs of times instead (cost_json.c).
static DipErrorCode open_visits(const DipFieldAt *at, int count) {
    const DipCostReport *report = dip_cost_report_of(at);
    return count == 0 || (report->starts > 0 && report->rounds % report->starts == 0)
               ? DIP_ERROR_NONE
               : DIP_ERROR_FORMAT;
}

static bool put_visit(const DipFieldAt *at, int index, const void *item) {
    const DipCostReport *report = dip_cost_report_of(at);
    const Visit *visit = item;
    (void)index;
    for (int i = 0; i < visit->count; i++) {
        DipTimed *timed = &visit->frames[i];
        timed->subject = visit->row;
        timed->start = visit->start;
        timed->round = visit->round;
        timed->block = visit->block;
        timed->begin_ns = llround(1e6 * visit->begin_ms);
        if (timed->frame >= dip_cost_frame_count(report)) {
            return false;
        }
    }
    return dip_cost_is_row(report, visit->row) && visit->start < report->starts &&
           visit->round < report->rounds / report->starts;
}

// Makes room for the frames of a visit at the end of the log.
static DipErrorCode open_frames(const DipFieldAt *at, int count) {
    DipCostReport *report = dip_cost_report_of(at);
    Visit *visit = (Visit *)at->item;
    const int64_t needed = (int64_t)report->log_count + count;
    if (count < 1 ||
        needed > (int64_t)MOST_TIMES * report->row_count * dip_cost_frame_count(report)) {
        return DIP_ERROR_FORMAT;
    }
    DipTimed *log = realloc(report->log, (size_t)needed * sizeof *log);
    if (!log) {
        return DIP_ERROR_MEMORY;
    }
    visit->frames = log + report->log_count;
    visit->count = count;
    memset(visit->frames, 0, (size_t)count * sizeof *log);
    report->log = log;
    report->log_count = (int)needed;
    return DIP_ERROR_NONE;
}

static DipErrorCode open_times(const DipFieldAt *at, int count) {
    return count == ((const Visit *)at->item)->count ? DIP_ERROR_NONE : DIP_ERROR_FORMAT;
}

DIP_OF_ITEM(bool, is_wait_known, isfinite(((const DipTimed *)at->item)[at->index].wait))

#define OF_FRAME(KIND, member) DIP_FACT(KIND, DipTimed, member), .stride = sizeof(DipTimed)
static const DipField frame_element = {OF_FRAME(WHOLE, frame), .most = INT_MAX};
static const DipField ms_element = {OF_FRAME(NUMBER, ms), .least = DIP_COST_LEAST_MS,
                                    .most = DIP_COST_MOST_MS};
static const DipField wait_element = {OF_FRAME(NUMBER, wait), .most = DIP_COST_MOST_MEAN,
                                      .known = is_wait_known};

#define OF_FRAMES(ELEMENT, OPEN)                                                                   \
    DIP_LIST(.element = &(ELEMENT), DIP_ARRAY(Visit, frames, count), .points = true, .open = OPEN)
static const DipField visit_fields[] = {
    {"row", NULL, NULL, "Index of the row whose frames were timed.", DIP_FACT(WHOLE, Visit, row),
     .most = DIP_COST_MAX_ROWS - 1},
    {"start", NULL, NULL,
     "Index of the start of the program in which the frames were timed, from 0 on.",
     DIP_FACT(WHOLE, Visit, start), .most = DIP_TIMED_MOST_STARTS - 1},
    {"round", NULL, NULL, "Index of the round within this start, from 0 on.",
     DIP_FACT(WHOLE, Visit, round), .most = INT_MAX},
    {"block", NULL, NULL,
     "Visits of one block are compared with each other; the blocks of a round have different "
     "numbers.",
     DIP_FACT(WHOLE, Visit, block), .most = INT_MAX - 1},
    {"begin_ms", NULL, "ms", "Time from the beginning of the measurement to that of the visit.",
     DIP_FACT(NUMBER, Visit, begin_ms), .most = DIP_COST_MOST_MS},
    {"frames", NULL, NULL, "Indices of the visit's frames along the path.",
     OF_FRAMES(frame_element, open_frames)},
    {"ms", NULL, NULL, "Time of each of the visit's frames, in milliseconds.",
     OF_FRAMES(ms_element, open_times)},
    {"wait", NULL, NULL,
     "Time that the frame's threads waited for a processor, as a share of its time; null if the "
     "machine does not tell.",
     OF_FRAMES(wait_element, open_times)},
};
static const DipRecord visit_record = DIP_RECORD(
    "visit", "A few frames of one row, timed one after another.", visit_fields, Visit, NULL);

const DipFieldList dip_cost_visit_list = {.record = &visit_record,
                                          .count = count_visits,
                                          .item = get_visit,
                                          .open = open_visits,
                                          .put = put_visit};
