// Makes lines from two lists: of good requests, and of requests that each break one rule.
#include "tests/app/control/random_lines.h"

#include <stdio.h>
#include <string.h>

// The rest of a request after {"id":N,
static const char *const good[] = {
    "\"request\":\"set\",\"pane\":\"requested\",\"settings\":\"aa=4,af=16\"}",
    "\"request\":\"set\",\"pane\":\"current\",\"change\":\"aa=8,asd=1\"}",
    "\"request\":\"set\",\"pane\":[\"current\",\"requested\"],\"change\":\"aa=none,asd=1\"}",
    "\"request\":\"set\",\"pane\":\"requested\",\"change\":\"miplod=quality,taa=on\"}",
    "\"request\":\"apply\"}",
    "\"request\":\"pause\"}",
    "\"request\":\"play\"}",
    "\"request\":\"seek\",\"time_s\":1.5}",
    "\"request\":\"seek\",\"time_s\":0}",
    "\"request\":\"subscribe\",\"to\":\"settings\"}",
    "\"request\":\"subscribe\",\"to\":[\"times\",\"errors\",\"notices\"]}",
    "\"request\":\"unsubscribe\",\"to\":[\"times\",\"errors\",\"settings\",\"notices\"]}",
    "\"request\":\"get\"}",
    "\"request\":\"get\",\"what\":[\"settings\",\"paths\",\"steps\"]}",
    "\"request\":\"pick\",\"x\":3,\"y\":2}",
    " \"request\" : \"p\\u0061use\" }\t",
};

static const char *const bad[] = {
    "",
    "\"request\":\"set\"}",
    "\"request\":\"fly\"}",
    "\"request\":null}",
    "\"request\":\"apply\",\"request\":\"apply\"}",
    "\"request\":\"apply\",\"id\":3}",
    "\"request\":\"apply\",\"pane\":\"current\"}",
    "\"request\":\"apply\"}}",
    "\"request\":\"apply\"} {}",
    "\"request\":\"set\",\"pane\":\"left\",\"change\":\"aa=4\"}",
    "\"request\":\"set\",\"pane\":[],\"change\":\"aa=4\"}",
    "\"request\":\"set\",\"pane\":\"current\"}",
    "\"request\":\"set\",\"pane\":\"current\",\"settings\":\"aa=5\"}",
    "\"request\":\"set\",\"pane\":\"current\",\"settings\":\"aa=4\",\"change\":\"af=2\"}",
    "\"request\":\"set\",\"pane\":\"current\",\"settings\":\"asd=3\"}",
    "\"request\":\"set\",\"pane\":\"current\",\"settings\":7}",
    "\"request\":\"seek\",\"time_s\":-1}",
    "\"request\":\"seek\",\"time_s\":1e999}",
    "\"request\":\"seek\",\"time_s\":\"1\"}",
    "\"request\":\"size\",\"width\":100}",
    "\"request\":\"size\",\"width\":1e9,\"height\":100}",
    "\"request\":\"size\",\"width\":10.5,\"height\":100}",
    "\"request\":\"subscribe\",\"to\":\"everything\"}",
    "\"request\":\"subscribe\",\"to\":\"sizes\"}",
    "\"request\":\"get\",\"what\":{}}",
    "\"request\":\"path\",\"category\":\"\"}",
    "\"request\":\"quit\",\"now\":true}",
    "\"request\":\"pause\x01\"}",
    "\"request\":\"pause\\u0000\"}",
    "\"request\":\"\xc3\x28\"}",
    "\"request\":\"\xed\xa0\x80\"}",
    "\"request\":\"\\ud800\"}",
    "\"request\":[[[[[[[[[[[[[[[[[[[[[[[[[[[[]]]]]]]]]]]]]]]]]]]]]]]]]]]]}",
};

static unsigned next(uint32_t *random, unsigned count) {
    *random = *random * 1664525u + 1013904223u;
    return (*random >> 8) % count;
}

static void damage(RandomLine *line, uint32_t *random) {
    const unsigned changes = 1 + next(random, 4);
    for (unsigned i = 0; i < changes; ++i) {
        char *byte = &line->bytes[next(random, (unsigned)line->length)];
        *byte = (char)(next(random, 3) ? "{}[]\",:\\0129eu-"[next(random, 15)]
                                       : (int)next(random, 256));
        *byte = *byte == '\n' ? ' ' : *byte;
    }
    if (next(random, 4) == 0) {
        line->length = next(random, (unsigned)line->length + 1);
    }
}

void random_line_make(RandomLine *line, uint32_t *random, int id) {
    const size_t good_count = sizeof good / sizeof *good;
    const size_t bad_count = sizeof bad / sizeof *bad;
    line->kind = (RandomLineKind)next(random, 3);
    const char *rest = line->kind == RANDOM_LINE_BAD ? bad[next(random, (unsigned)bad_count)]
                                                     : good[next(random, (unsigned)good_count)];
    const int length = snprintf(line->bytes, sizeof line->bytes, "{\"id\":%d,%s", id, rest);
    line->length = (size_t)length;
    if (line->kind == RANDOM_LINE_DAMAGED) {
        damage(line, random);
    }
}
