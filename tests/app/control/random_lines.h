// Random lines for the control channel, good ones and bad ones.
#ifndef DIP_TESTS_APP_CONTROL_RANDOM_LINES_H
#define DIP_TESTS_APP_CONTROL_RANDOM_LINES_H

#include <stddef.h>
#include <stdint.h>

typedef enum RandomLineKind {
    RANDOM_LINE_GOOD,   // The channel must accept the line.
    RANDOM_LINE_BAD,    // The line breaks one rule of the protocol.
    RANDOM_LINE_DAMAGED // A good line with a few changed bytes: anything may be right.
} RandomLineKind;

enum { RANDOM_LINE_SIZE = 1024 };

typedef struct RandomLine {
    RandomLineKind kind;
    size_t length; // Bytes, without a line feed; the bytes hold none.
    char bytes[RANDOM_LINE_SIZE];
} RandomLine;

// Makes a line. *random is the generator's state. `id` becomes the id of good and bad lines.
void random_line_make(RandomLine *line, uint32_t *random, int id);

#endif
