// The checks that the random search makes of a scene.
#ifndef DIP_TESTS_STABILITY_SEARCH_CHECK_H
#define DIP_TESTS_STABILITY_SEARCH_CHECK_H

#include "tests/stability/search/scene_from_choices.h"

// What a check found. check is NULL if everything is right.
typedef struct SearchFinding {
    const char *check; // name of the check, static
    double size;       // size of the error, for comparisons
    char text[500];    // the error in words
} SearchFinding;

// The pools to draw with. Both are borrowed.
typedef struct SearchBench {
    DipPool *pool_of_one;
    DipPool *pool_of_many;
} SearchBench;

// Makes the scene of the choices, from the first one, and checks it. Stops at the first finding.
// If `only` is not NULL, makes only the check with this name. Returns true if nothing was found.
bool search_check(const SearchBench *bench, Choices *choices, const char *only,
                  SearchFinding *finding);

// Compares the pictures of the fast renderer with the reference. Returns true if they agree.
bool search_check_reference(const SearchBench *bench, Choices *choices, SearchFinding *finding);

// Compares pictures that must have the same bits. Returns true if they do.
bool search_check_invariances(const SearchBench *bench, Choices *choices, const char *only,
                              SearchFinding *finding);

// Sets *finding and returns false.
bool search_found(SearchFinding *finding, const char *check, double size, const char *format, ...)
    DIP_PRINTF(4, 5);

// Returns a vertex of an object relative to the eye, in world space, computed in double.
void search_vertex_from_eye(const SearchScene *made, const DipObjectDef *object, uint32_t vertex,
                            double offset[3]);

// Returns the distance of a point (relative to the eye) along the view axis.
double search_depth(const SearchScene *made, const double offset[3]);

#endif
