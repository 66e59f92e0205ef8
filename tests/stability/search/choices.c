// Draws, records and replays the choices of the random search.
#include "tests/stability/search/choices.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void choices_begin(Choices *choices, uint64_t seed) {
    choices->count = 0;
    choices->cursor = 0;
    choices->part_count = 0;
    choices->recorded = false;
    choices->mirrored = false;
    choices->random = (Random){seed};
}

void choices_rewind(Choices *choices) {
    choices->cursor = 0;
    choices->part_count = 0;
    choices->recorded = true;
}

uint64_t choices_draw(Choices *choices, uint64_t bound) {
    if (choices->cursor >= CHOICES_MAX) {
        return 0;
    }
    if (choices->recorded) {
        return choices->cursor < choices->count ? choices->values[choices->cursor++] % bound : 0;
    }
    const uint64_t value = random_u64(&choices->random) % bound;
    choices->values[choices->cursor++] = value;
    choices->count = choices->cursor;
    return value;
}

int choices_begin_part(Choices *choices, int length_index) {
    if (choices->part_count >= CHOICES_MAX_PARTS) {
        return -1;
    }
    choices->parts[choices->part_count] =
        (ChoicesPart){choices->cursor, choices->cursor, length_index};
    return choices->part_count++;
}

void choices_end_part(Choices *choices, int part) {
    if (part >= 0) {
        choices->parts[part].end = choices->cursor;
    }
}

bool choices_rarely(Choices *choices, int one_in) {
    return choices_draw(choices, (uint64_t)one_in) + 1 == (uint64_t)one_in;
}

int choices_signed(Choices *choices, int most) {
    const int value = (int)choices_draw(choices, 2 * (uint64_t)most + 1);
    return value & 1 ? (value + 1) / 2 : -(value / 2);
}

double choices_real(Choices *choices, double most) {
    enum { STEPS_FEW = 8, STEPS_SOME = 256, STEPS_MANY = 1 << 23 };
    static const int steps[] = {STEPS_FEW, STEPS_FEW, STEPS_SOME, STEPS_MANY, STEPS_MANY};
    const int count = steps[choices_draw(choices, sizeof steps / sizeof *steps)];
    return most * choices_signed(choices, count) / count;
}

double choices_power(Choices *choices, int low, int high) {
    const int most = high > -low ? high : -low;
    int exponent = choices_signed(choices, most);
    exponent = exponent < low ? low : exponent > high ? high : exponent;
    return ldexp(1.0, exponent);
}

// Skips white space and comments. Returns the next character, which stays unread, or EOF.
static int skip_to_number(FILE *in) {
    int c = getc(in);
    while (c == ' ' || c == '\t' || c == '\r' || c == '\n' || c == '#') {
        while (c == '#') {
            do {
                c = getc(in);
            } while (c != '\n' && c != EOF);
        }
        c = c == EOF ? EOF : getc(in);
    }
    return c == EOF ? EOF : ungetc(c, in);
}

static bool read_number(FILE *in, uint64_t *value) {
    char text[24];
    size_t length = 0;
    int c = getc(in);
    while (c >= '0' && c <= '9' && length + 1 < sizeof text) {
        text[length++] = (char)c;
        c = getc(in);
    }
    text[length] = '\0';
    errno = 0;
    *value = strtoull(text, NULL, 10);
    return length > 0 && errno == 0 && (c == ' ' || c == '\r' || c == '\n' || c == EOF);
}

bool choices_load(Choices *choices, const char *file) {
    FILE *in = fopen(file, "r");
    if (!in) {
        return false;
    }
    choices_begin(choices, 0);
    bool good = true;
    while (good && skip_to_number(in) != EOF) {
        good = choices->count < CHOICES_MAX && read_number(in, &choices->values[choices->count]);
        choices->count += good;
    }
    choices_rewind(choices);
    good = good && !ferror(in);
    fclose(in);
    return good;
}

bool choices_save(const Choices *choices, const char *file, const char *comment) {
    FILE *out = fopen(file, "w");
    if (!out) {
        return false;
    }
    if (comment) {
        fprintf(out, "%s\n", comment);
    }
    for (int i = 0; i < choices->count; i++) {
        fprintf(out, "%llu%c", (unsigned long long)choices->values[i],
                i % 16 == 15 || i + 1 == choices->count ? '\n' : ' ');
    }
    const bool good = !ferror(out);
    return fclose(out) == 0 && good;
}
