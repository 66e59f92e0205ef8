// A sequence of integers from which the random search makes a scene.
//
// The generator of scenes asks for one number after another. While a scene is being searched, the
// numbers come from a random generator and are recorded. Later, a recorded sequence can be changed
// and replayed. Every sequence gives a valid scene: a number that is too large is reduced to the
// range asked for, and after the end of the sequence every number is 0. The generator must give the
// number 0 the simplest meaning, so that shorter sequences and smaller numbers make simpler scenes.
#ifndef DIP_TESTS_STABILITY_SEARCH_CHOICES_H
#define DIP_TESTS_STABILITY_SEARCH_CHOICES_H

#include "renderer/catalogue/random.h"

#include <stdbool.h>
#include <stdint.h>

enum {
    CHOICES_MAX = 8192,       // numbers in a sequence; after that, every number is 0
    CHOICES_MAX_PARTS = 1024, // parts that a sequence remembers
};

// The numbers of one element of a list, for example of an object or of a triangle. The list stays
// whole if these numbers are deleted and its length is lowered by 1.
typedef struct ChoicesPart {
    int first;        // index of the element's first number
    int end;          // index after its last number
    int length_index; // index of the number that holds the list's length; -1 if there is none
} ChoicesPart;

typedef struct Choices {
    uint64_t values[CHOICES_MAX];
    int count;     // numbers in the sequence
    int cursor;    // index of the number that is read next
    bool recorded; // true: read `values`; false: draw new numbers from `random`
    bool mirrored; // true: new scenes have mirrored textures
    Random random;
    ChoicesPart parts[CHOICES_MAX_PARTS];
    int part_count;
} Choices;

// Begins a sequence of new random numbers.
void choices_begin(Choices *choices, uint64_t seed);

// Begins to read the recorded numbers again from the first one.
void choices_rewind(Choices *choices);

// Returns a number from 0 to bound - 1. bound must be at least 1.
uint64_t choices_draw(Choices *choices, uint64_t bound);

// Begins and ends the numbers of one element of a list. Returns the index of the part.
int choices_begin_part(Choices *choices, int length_index);
void choices_end_part(Choices *choices, int part);

// Returns true for one new random number in `one_in`, and false for the number 0.
bool choices_rarely(Choices *choices, int one_in);

// Returns a whole number from -most to most. The numbers 0, 1, 2, 3... mean 0, 1, -1, 2...
int choices_signed(Choices *choices, int most);

// Returns a number from -most to most, with few bits or with 24 bits.
double choices_real(Choices *choices, double most);

// Returns 2^n with n from low to high. The number 0 means n = 0, which must lie in this range.
double choices_power(Choices *choices, int low, int high);

// Reads the numbers of a file, which separates them by white space. A line that begins with # is a
// comment. Returns false if the file cannot be read, or holds something else or too many numbers.
bool choices_load(Choices *choices, const char *file);

// Writes the numbers to a file. comment, which may be NULL, becomes the first lines; each of its
// lines must begin with #. Returns false if the file cannot be written.
bool choices_save(const Choices *choices, const char *file, const char *comment);

#endif
