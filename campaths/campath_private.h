// The layout of a path and the rules for its keys, shared by the parts of campaths/. Private to
// campaths/.
#ifndef DIP_CAMPATHS_CAMPATH_PRIVATE_H
#define DIP_CAMPATHS_CAMPATH_PRIVATE_H

#include "campaths/campath.h"

#include <stdio.h>

struct DipCamPath {
    int64_t period_ns;
    int64_t duration_ns;
    // Sign of the first key's quaternion in the closing step, from the last key to the first: -1 if
    // it must be negated there for the shortest arc, else +1.
    double closing_sign;
    size_t key_count;
    DipCamKey keys[];
};

extern const unsigned char dip_campath_magic[8];
extern const char *const dip_campath_key_names[7]; // "x" .. "qw"

// Allocates a path of key_count keys (1..DIP_CAMPATH_MAX_KEYS) and fills in all but the keys.
// Returns NULL and fills *err when memory runs out.
DipCamPath *dip_campath_allocate(size_t key_count, int64_t period_ns, const char *name,
                                 DipError *err);

// Derives closing_sign from the keys, which must have passed dip_campath_admit or the checks of the
// binary format.
void dip_campath_finish(DipCamPath *path);

// Returns component 0..6 of a key. The order is x, y, z, qx, qy, qz, qw, as in the files.
double dip_campath_component(const DipCamKey *key, int index);

// True if the squared length is within DIP_CAMPATH_UNIT_TOLERANCE of 1.
bool dip_campath_is_unit(const double q[4]);
double dip_campath_dot(const double a[4], const double b[4]);

// Checks the ranges of a key, normalises its orientation and moves it to the hemisphere of the key
// before it (NULL: this is the first key). Errors carry the name and line.
bool dip_campath_admit(DipCamKey *key, const DipCamKey *before, const char *name, int line,
                       DipError *err);

bool dip_campath_parse_text(const char *text, size_t size_bytes, const char *name,
                            DipCamPath **path, DipError *err);
bool dip_campath_parse_binary(const unsigned char *bytes, size_t size_bytes, const char *name,
                              DipCamPath **path, DipError *err);

// Writes the text format. The caller must check the stream for errors afterwards.
void dip_campath_write_text(const DipCamPath *path, FILE *stream);
void dip_campath_write_binary(const DipCamPath *path, FILE *stream);

#endif
