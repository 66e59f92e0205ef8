// Compares cost reports for tests/app/cost/kills.sh and machines.sh. It reads cost.json and
// cost.state itself, so that it does not depend on the program's own readers.
//
//   compare_reports same A.json B.json TOLERANCE
//       Everything but times must be equal: errors, counters, hashes, rows, sweeps. Numbers that
//       are computed from the error sums may differ by the relative tolerance. Both reports must
//       have equally many times, all of them plausible.
//   compare_reports kept REPORT.json JOURNAL
//       The times that the journal has must be in the report, unless they were disturbed. Prints
//       their number.
//   compare_reports forge JOURNAL [errors] [round]
//       Changes the values of these kinds of lines and mends the checksums. A report that joins
//       such a line shows it.
#include "app/measure/stats/rounds.h"
#include "renderer/base/hash.h"

#include <cjson/cJSON.h>
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_VALUES = 1 << 20 };

static const double forged_ms = 1e6;
static const double most_ms = 1e5;

static double tolerance;
static int faults;

static void fault(const char *path, const char *what) {
    if (faults++ < 10) {
        printf("%s: %s\n", path, what);
    }
}

static char *read_whole(const char *name) {
    FILE *in = fopen(name, "rb");
    char *text = NULL;
    size_t size = 0;
    FILE *to = open_memstream(&text, &size);
    if (!in || !to) {
        fprintf(stderr, "%s: cannot be read\n", name);
        exit(2);
    }
    for (int c; (c = getc(in)) != EOF;) {
        putc(c, to);
    }
    fclose(in);
    fclose(to);
    return text;
}

static cJSON *read_report(const char *name) {
    char *text = read_whole(name);
    cJSON *root = cJSON_Parse(text);
    free(text);
    if (!root) {
        fprintf(stderr, "%s: is not JSON\n", name);
        exit(2);
    }
    return root;
}

// --- same ----------------------------------------------------------------------------------------

static bool is_one_of(const char *key, const char *const *keys) {
    while (key && *keys && strcmp(key, *keys) != 0) {
        keys++;
    }
    return key && *keys;
}

static bool is_time(const char *key) {
    static const char *const keys[] = {"seed",        "date",       "machine",      "fit",
                                       "advice",      "time",       "ms",           "ms_low",
                                       "ms_high",     "p95_ms",     "p95_ms_low",   "ratio",
                                       "p95_ms_high", "worst_ms",   "worst_ms_low", "worst_ms_high",
                                       "ratio_low",   "ratio_high", "stages_ms",    NULL};
    return is_one_of(key, keys);
}

static bool is_measured(const char *key) {
    static const char *const keys[] = {"sums", "half_against_half", "counters", NULL};
    return is_one_of(key, keys);
}

// The order of visits is random, and frames may be drawn again.
static void compare_visits(const char *path, const cJSON *a, const cJSON *b) {
    const cJSON *visit, *ms;
    if (cJSON_GetArraySize(a) == 0 || cJSON_GetArraySize(b) == 0) {
        fault(path, "are missing in one of the reports");
    }
    cJSON_ArrayForEach(visit, b) {
        cJSON_ArrayForEach(ms, cJSON_GetObjectItemCaseSensitive(visit, "ms")) {
            if (!(ms->valuedouble > 0.0 && ms->valuedouble <= most_ms)) {
                fault(path, "have a time that was not measured");
            }
        }
    }
}

static void compare_numbers(const char *path, const cJSON *a, const cJSON *b, bool exactly) {
    const double x = a->valuedouble, y = b->valuedouble;
    const double allowed = exactly ? 0.0 : tolerance * fmax(fabs(x), fabs(y));
    if (!(fabs(x - y) <= allowed) && !(isnan(x) && isnan(y))) {
        char text[128];
        snprintf(text, sizeof text, "is %.17g and %.17g", x, y);
        fault(path, text);
    }
}

static void compare(const char *path, const cJSON *a, const cJSON *b, bool exactly) {
    if (!a || !b || (a->type & 0xff) != (b->type & 0xff)) {
        fault(path, "is missing in one of the reports");
    } else if (cJSON_IsNumber(a)) {
        compare_numbers(path, a, b, exactly);
    } else if (cJSON_IsString(a)) {
        if (strcmp(a->valuestring, b->valuestring) != 0) {
            fault(path, "is another text");
        }
    } else if (cJSON_GetArraySize(a) != cJSON_GetArraySize(b)) {
        fault(path, "has another number of items");
    }
    const cJSON *item, *items = b ? a : NULL;
    int index = 0;
    cJSON_ArrayForEach(item, items) {
        char to[512];
        const cJSON *other = item->string ? cJSON_GetObjectItemCaseSensitive(b, item->string)
                                          : cJSON_GetArrayItem(b, index);
        if (item->string) {
            snprintf(to, sizeof to, "%.400s.%.100s", path, item->string);
        } else {
            snprintf(to, sizeof to, "%.400s[%d]", path, index);
        }
        index++;
        if (item->string && strcmp(item->string, "visits") == 0) {
            compare_visits(to, item, other);
        } else if (!is_time(item->string)) {
            compare(to, item, other, exactly || is_measured(item->string));
        }
    }
}

// --- the journal ---------------------------------------------------------------------------------

// Reads the numbers of a line up to its end. Returns how many there are.
static int read_values(const char *from, double *values) {
    int count = 0;
    for (char *end; count < MAX_VALUES; count++, from = end) {
        values[count] = strtod(from, &end);
        if (end == from) {
            break;
        }
    }
    return count;
}

// The line's values end before its checksum, which may look like a number.
static char *cut_check(char *line) {
    char *last = strrchr(line, ' ');
    if (last) {
        *last = '\0';
    }
    return last;
}

// The numbers of a frame in a line of the journal.
enum { SUBJECT, START, ROUND, BLOCK, FRAME, BEGIN, MS, WAIT, FRAME_VALUES = 14 };

static bool has_number(const cJSON *visit, const char *key, double value) {
    return cJSON_GetObjectItemCaseSensitive(visit, key)->valuedouble == value;
}

// Returns the time that the report has for a frame of the journal.
static double reported(const cJSON *root, const double *frame) {
    const cJSON *visit;
    cJSON_ArrayForEach(visit, cJSON_GetObjectItemCaseSensitive(root, "visits")) {
        const cJSON *number, *ms = cJSON_GetObjectItemCaseSensitive(visit, "ms")->child;
        const bool wanted =
            has_number(visit, "row", frame[SUBJECT]) && has_number(visit, "start", frame[START]) &&
            has_number(visit, "round", frame[ROUND]) && has_number(visit, "block", frame[BLOCK]);
        const cJSON *frames = wanted ? cJSON_GetObjectItemCaseSensitive(visit, "frames") : NULL;
        cJSON_ArrayForEach(number, frames) {
            if (number->valuedouble == frame[FRAME]) {
                return ms->valuedouble;
            }
            ms = ms->next;
        }
    }
    return NAN;
}

static void expect_time(const cJSON *root, const double *frame) {
    // cJSON writes 15 digits.
    if (!(fabs(reported(root, frame) - frame[MS]) <= 1e-14 * frame[MS])) {
        char text[128];
        snprintf(text, sizeof text, "frame %.0f of row %.0f has %.17g, the journal %.17g",
                 frame[FRAME], frame[SUBJECT], reported(root, frame), frame[MS]);
        fault("ms", text);
    }
}

// The baseline of a path draws more frames in a round than its rows do.
static bool is_baseline(const double *frames, int count, double subject, int timed) {
    int drawn = 0;
    for (int i = 0; i < count; i++) {
        drawn += frames[i * FRAME_VALUES + SUBJECT] == subject;
    }
    return drawn > timed;
}

// Returns the frame of the baseline beside a frame: the same one in the same block.
static const double *find_base(const double *frames, int count, const double *frame, int timed) {
    for (const double *other = frames; other < frames + count * FRAME_VALUES;
         other += FRAME_VALUES) {
        if (other[BLOCK] == frame[BLOCK] && other[FRAME] == frame[FRAME] &&
            is_baseline(frames, count, other[SUBJECT], timed)) {
            return other;
        }
    }
    fault("journal", "a frame has no baseline beside it");
    return frame;
}

static int expect_round(const cJSON *root, const double *values, int count) {
    const int timed = cJSON_GetObjectItem(root, "timed_frames")->valueint;
    const cJSON *rows = cJSON_GetObjectItem(root, "rows");
    const int frames = (count - 1) / FRAME_VALUES;
    int kept = 0;
    if (count != 1 + frames * FRAME_VALUES) {
        fault("journal", "a round has another number of values");
        return 0;
    }
    for (int i = 0; i < frames; i++) {
        const double *frame = values + 1 + i * FRAME_VALUES;
        if (frame[BLOCK] >= cJSON_GetArraySize(rows)) {
            continue; // A repetition.
        }
        const double *base = find_base(values + 1, frames, frame, timed);
        if (base != frame && frame[WAIT] <= DIP_TIMED_MOST_WAIT &&
            base[WAIT] <= DIP_TIMED_MOST_WAIT) {
            expect_time(root, frame);
            expect_time(root, base);
            kept++;
        }
    }
    return kept;
}

static void expect_kept(const char *report, const char *journal) {
    cJSON *root = read_report(report);
    char *text = read_whole(journal);
    double *values = malloc(MAX_VALUES * sizeof *values);
    char *place = NULL;
    int kept = 0;
    // A line that was cut short has no line break. The program drops it.
    char *whole = strrchr(text, '\n');
    *(whole ? whole : text) = '\0';
    for (char *line = strtok_r(text, "\n", &place); values && line;
         line = strtok_r(NULL, "\n", &place)) {
        if (strncmp(line, "round ", 6) == 0 && cut_check(line)) {
            kept += expect_round(root, values, read_values(line + 6 + 33, values));
        }
    }
    printf("%d\n", kept);
    free(values);
    free(text);
    cJSON_Delete(root);
}

static void forge_values(double *values, int count, bool is_round) {
    for (int i = is_round; i < count; i++) {
        if (!is_round) {
            values[i] += 1000.0;
        } else if ((i - 1) % FRAME_VALUES == MS) {
            values[i] = forged_ms;
        }
    }
}

static void write_line(FILE *out, const char *head, size_t head_size, const double *values,
                       int count) {
    char *text = NULL;
    size_t size = 0;
    char check[DIP_HASH_HEX_SIZE];
    FILE *line = open_memstream(&text, &size);
    fwrite(head, 1, head_size, line);
    for (int i = 0; i < count; i++) {
        fprintf(line, " %a", values[i]);
    }
    fclose(line);
    DipHash hash = dip_hash_begin(0);
    dip_hash_bytes(&hash, text, size);
    dip_hash_hex(&hash, check);
    fprintf(out, "%s %s\n", text, check);
    free(text);
}

static void forge(const char *journal, char *const *kinds, int kind_count) {
    char *text = read_whole(journal);
    double *values = malloc(MAX_VALUES * sizeof *values);
    FILE *out = fopen(journal, "wb");
    char *place = NULL;
    int forged = 0;
    char *whole = strrchr(text, '\n');
    *(whole ? whole : text) = '\0';
    for (char *line = strtok_r(text, "\n", &place); values && out && line;
         line = strtok_r(NULL, "\n", &place)) {
        const bool is_round = strncmp(line, "round ", 6) == 0;
        const size_t head = (is_round ? 6 : 7) + 32;
        bool wanted = false;
        for (int i = 0; i < kind_count; i++) {
            wanted |= strncmp(line, kinds[i], strlen(kinds[i])) == 0;
        }
        if (wanted && cut_check(line)) {
            const int count = read_values(line + head, values);
            forge_values(values, count, is_round);
            write_line(out, line, head, values, count);
            forged++;
        } else if (!wanted) {
            fprintf(out, "%s\n", line);
        }
    }
    if (!out || fclose(out) != 0 || forged == 0) {
        fault(journal, "has no line to forge");
    }
    free(values);
    free(text);
}

int main(int argc, char **argv) {
    if (argc == 5 && strcmp(argv[1], "same") == 0) {
        cJSON *a = read_report(argv[2]), *b = read_report(argv[3]);
        tolerance = strtod(argv[4], NULL);
        compare("report", a, b, false);
        cJSON_Delete(a);
        cJSON_Delete(b);
    } else if (argc == 4 && strcmp(argv[1], "kept") == 0) {
        expect_kept(argv[2], argv[3]);
    } else if (argc >= 4 && strcmp(argv[1], "forge") == 0) {
        forge(argv[2], argv + 3, argc - 3);
    } else {
        fprintf(stderr, "usage: compare_reports same|kept|forge ...\n");
        return 2;
    }
    return faults ? 1 : 0;
}
