// Runs the checks of a scene, and computes what they share.
#include "tests/stability/search/check.h"

#include <stdarg.h>
#include <string.h>

bool search_found(SearchFinding *finding, const char *check, double size, const char *format, ...) {
    finding->check = check;
    finding->size = size;
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(finding->text, sizeof finding->text, format, arguments);
    va_end(arguments);
    return false;
}

void search_vertex_from_eye(const SearchScene *made, const DipObjectDef *object, uint32_t vertex,
                            double offset[3]) {
    const float *p = made->scene.meshes[object->mesh].positions + 3 * (size_t)vertex;
    for (int i = 0; i < 3; i++) {
        const float *m = object->transform + 4 * i;
        offset[i] = (double)m[3] - made->scene.pose.position_world[i] +
                    ((double)m[0] * (double)p[0] + (double)m[1] * (double)p[1] +
                     (double)m[2] * (double)p[2]);
    }
}

double search_depth(const SearchScene *made, const double offset[3]) {
    const double *q = made->scene.pose.orientation;
    const double x = q[0], y = q[1], z = q[2], w = q[3];
    return -(2 * (x * z + w * y) * offset[0] + 2 * (y * z - w * x) * offset[1] +
             (1 - 2 * (x * x + y * y)) * offset[2]);
}

static bool is_of_reference(const char *name) {
    return strcmp(name, "reference") == 0 || strcmp(name, "rotated corners") == 0 ||
           strcmp(name, "drawing") == 0;
}

bool search_check(const SearchBench *bench, Choices *choices, const char *only,
                  SearchFinding *finding) {
    *finding = (SearchFinding){0};
    if (only && is_of_reference(only) && strcmp(only, "drawing") != 0) {
        return search_check_reference(bench, choices, finding);
    }
    return search_check_invariances(bench, choices, only, finding) &&
           ((only && !is_of_reference(only)) || search_check_reference(bench, choices, finding));
}
