// Changes glTF files at random (mutate.h).
#include "tests/fuzz/gltf/mutate.h"

#include <ctype.h>
#include <stdbool.h>
#include <string.h>

// Offsets in a .glb file with its two chunks, of which the first one is the JSON.
enum { GLB_SIZE_AT = 8, GLB_JSON_SIZE_AT = 12, GLB_JSON_AT = 20 };

typedef struct Mutant {
    Random *random;
    uint8_t *bytes;
    size_t size;
    size_t room;
    bool is_glb;
    size_t json; // The JSON's first byte.
    size_t end;  // The first byte behind the JSON.
} Mutant;

// A part of the file.
typedef struct Span {
    size_t begin;
    size_t size;
} Span;

// Returns a number from 0 to count - 1. count is at least 1.
static size_t below(Mutant *mutant, size_t count) {
    return (size_t)(random_u64(mutant->random) % count);
}

static uint32_t read_u32(const uint8_t *at) {
    return at[0] | (uint32_t)at[1] << 8 | (uint32_t)at[2] << 16 | (uint32_t)at[3] << 24;
}

static void write_u32(uint8_t *at, uint32_t value) {
    for (int i = 0; i < 4; i++) {
        at[i] = (uint8_t)(value >> 8 * i);
    }
}

static void find_json(Mutant *mutant) {
    mutant->is_glb = mutant->size >= GLB_JSON_AT && memcmp(mutant->bytes, "glTF", 4) == 0;
    mutant->json = mutant->is_glb ? GLB_JSON_AT : 0;
    mutant->end = mutant->size;
    if (mutant->is_glb) {
        const size_t json_bytes = read_u32(mutant->bytes + GLB_JSON_SIZE_AT);
        const size_t rest = mutant->size - GLB_JSON_AT;
        mutant->end = GLB_JSON_AT + (json_bytes < rest ? json_bytes : rest);
    }
}

// --- the parts of the JSON -----------------------------------------------------------------------

// Returns the end of the text in quotation marks that begins at `at`.
static size_t skip_text(const Mutant *mutant, size_t at) {
    for (at++; at < mutant->end && mutant->bytes[at] != '"'; at++) {
        at += mutant->bytes[at] == '\\';
    }
    return at < mutant->end ? at + 1 : mutant->end;
}

// Returns the end of the object or array that begins at `at`.
static size_t skip_nest(const Mutant *mutant, size_t at) {
    int depth = 0;
    while (at < mutant->end) {
        const uint8_t c = mutant->bytes[at];
        if (c == '"') {
            at = skip_text(mutant, at);
            continue;
        }
        at++;
        depth += (c == '{' || c == '[') - (c == '}' || c == ']');
        if (depth <= 0) {
            break;
        }
    }
    return at;
}

static bool is_in_word(uint8_t c) {
    return isalnum(c) || c == '-' || c == '+' || c == '.';
}

static size_t skip_word(const Mutant *mutant, size_t at) {
    while (at < mutant->end && is_in_word(mutant->bytes[at])) {
        at++;
    }
    return at;
}

// Finds a random object, array, text (also a name), number or word; with only_numbers, a random
// number. Returns false if there is none.
static bool find_part(Mutant *mutant, bool only_numbers, Span *part) {
    const uint8_t *bytes = mutant->bytes;
    size_t count = 0;
    for (size_t at = mutant->json; at < mutant->end;) {
        const uint8_t c = bytes[at];
        const bool is_nest = c == '{' || c == '[';
        const size_t after = c == '"'        ? skip_text(mutant, at)
                             : is_in_word(c) ? skip_word(mutant, at)
                                             : at + 1;
        const bool is_number = isdigit(c) || c == '-';
        const bool is_part = is_number || (!only_numbers && (is_nest || after > at + 1));
        // The n-th part takes the place of the one chosen before with probability 1/n.
        if (is_part && below(mutant, ++count) == 0) {
            part->begin = at;
            part->size = after - at;
        }
        at = after;
    }
    if (count > 0 && (bytes[part->begin] == '{' || bytes[part->begin] == '[')) {
        part->size = skip_nest(mutant, part->begin) - part->begin;
    }
    return count > 0;
}

// Replaces a part by other bytes, which may lie in the file. Does nothing if there is no room.
static void replace(Mutant *mutant, Span part, const uint8_t *with, size_t with_bytes) {
    static uint8_t copy[1 << 20];
    if (with_bytes > sizeof copy || mutant->size - part.size + with_bytes > mutant->room) {
        return;
    }
    if (with_bytes > 0) {
        memcpy(copy, with, with_bytes);
    }
    const size_t after = part.begin + part.size;
    memmove(mutant->bytes + part.begin + with_bytes, mutant->bytes + after, mutant->size - after);
    memcpy(mutant->bytes + part.begin, copy, with_bytes);
    mutant->size = mutant->size - part.size + with_bytes;
    mutant->end = mutant->end - part.size + with_bytes;
}

// --- changes -------------------------------------------------------------------------------------

static void change_number(Mutant *mutant) {
    static const char *const numbers[] = {
        "-1",         "0",          "1",          "2",     "3",     "4",      "5",    "7",
        "8",          "16",         "63",         "64",    "255",   "256",    "0.5",  "-0.25",
        "65535",      "65536",      "1e-40",      "1e30",  "1e308", "-1e999", "1e9",  "-0",
        "2147483647", "2147483648", "4294967295", "1e18",  "5120",  "5121",   "5122", "5123",
        "5125",       "5126",       "33071",      "33648", "9728",  "9984"};
    const char *number = numbers[below(mutant, sizeof numbers / sizeof *numbers)];
    Span part;
    if (find_part(mutant, true, &part)) {
        replace(mutant, part, (const uint8_t *)number, strlen(number));
    }
}

// Puts a copy of a part of the JSON in the place of another part.
static void copy_part(Mutant *mutant) {
    Span from;
    Span to;
    if (find_part(mutant, false, &from) && find_part(mutant, false, &to)) {
        replace(mutant, to, mutant->bytes + from.begin, from.size);
    }
}

// Removes a part, or repeats it. Both also take the comma that follows it.
static void remove_or_repeat(Mutant *mutant) {
    Span part;
    if (!find_part(mutant, false, &part)) {
        return;
    }
    const size_t after = part.begin + part.size;
    part.size += after < mutant->end && mutant->bytes[after] == ',';
    if (below(mutant, 2) == 0) {
        replace(mutant, part, NULL, 0);
    } else {
        replace(mutant, (Span){part.begin, 0}, mutant->bytes + part.begin, part.size);
    }
}

static void change_byte(Mutant *mutant, size_t at) {
    uint8_t *byte = &mutant->bytes[at];
    switch (below(mutant, 4)) {
    case 0:
        *byte ^= (uint8_t)(1u << below(mutant, 8));
        break;
    case 1:
        *byte = (uint8_t)(below(mutant, 2) ? 0xff : 0);
        break;
    case 2:
        *byte = (uint8_t)(*byte + (below(mutant, 2) ? 1 : 0xff));
        break;
    default:
        *byte = (uint8_t)below(mutant, 256);
    }
}

// Changes a character of a "data:" address into another one that such addresses may have.
static void change_address(Mutant *mutant) {
    static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    static const char mark[] = "base64,";
    Span chosen = {0, 0};
    size_t count = 0;
    for (size_t at = mutant->json; at + sizeof mark < mutant->end; at++) {
        if (memcmp(mutant->bytes + at, mark, sizeof mark - 1) == 0) {
            at += sizeof mark - 1;
            size_t end = at;
            while (end < mutant->end && mutant->bytes[end] != '"') {
                end++;
            }
            if (below(mutant, ++count) == 0) {
                chosen = (Span){at, end - at};
            }
        }
    }
    if (chosen.size > 0) {
        mutant->bytes[chosen.begin + below(mutant, chosen.size)] =
            (uint8_t)digits[below(mutant, 64)];
    }
}

// Changes a run of bytes of the binary part, or characters of addresses.
static void change_content(Mutant *mutant) {
    if (mutant->end >= mutant->size) {
        change_address(mutant);
        return;
    }
    const size_t size = mutant->size - mutant->end;
    const size_t begin = below(mutant, size);
    const size_t run = 1 + below(mutant, 4);
    for (size_t i = begin; i < begin + run && i < size; i++) {
        change_byte(mutant, mutant->end + i);
    }
}

// Writes the lengths of the file and of its JSON into the header. The JSON's length must be a
// multiple of 4, which blanks at its end achieve.
static void mend_lengths(Mutant *mutant) {
    while ((mutant->end - mutant->json) % 4 != 0 && mutant->size < mutant->room) {
        replace(mutant, (Span){mutant->end, 0}, (const uint8_t *)" ", 1);
    }
    write_u32(mutant->bytes + GLB_SIZE_AT, (uint32_t)mutant->size);
    write_u32(mutant->bytes + GLB_JSON_SIZE_AT, (uint32_t)(mutant->end - mutant->json));
}

size_t mutate_gltf(Random *random, uint8_t *bytes, size_t size_bytes, size_t room_bytes) {
    Mutant mutant = {.random = random, .bytes = bytes, .size = size_bytes, .room = room_bytes};
    find_json(&mutant);
    const bool has_lengths = mutant.is_glb && below(&mutant, 16) > 0;
    // Files with few changes are read further.
    const int count = below(&mutant, 2) ? 1 : 1 + (int)below(&mutant, 6);
    for (int i = 0; i < count && mutant.size > 0; i++) {
        switch (below(&mutant, 8)) {
        case 0:
            change_byte(&mutant, below(&mutant, mutant.size));
            break;
        case 1:
            copy_part(&mutant);
            break;
        case 2:
            remove_or_repeat(&mutant);
            break;
        case 3:
        case 4:
            change_number(&mutant);
            break;
        default:
            change_content(&mutant);
        }
    }
    if (has_lengths) {
        mend_lengths(&mutant);
    }
    if (below(&mutant, 32) == 0) {
        mutant.size = below(&mutant, mutant.size + 1);
    }
    return mutant.size;
}
