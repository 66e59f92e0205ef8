// What the path's files share: its layout and the rules for a key.
#ifndef DIP_CAMPATHS_CAMPATH_PRIVATE_H
#define DIP_CAMPATHS_CAMPATH_PRIVATE_H

#include "campaths/campath.h"

#include <stdio.h>

struct DipCamPath {
    int64_t period_ns;
    int64_t duration_ns;
    // The last orientation as seen from the first: +1, or -1 when the closing step must negate the
    // first key's quaternion to take the short way.
    double closing_sign;
    size_t key_count;
    DipCamKey keys[];
};

extern const unsigned char dip_campath_magic[8];
extern const char *const dip_campath_key_names[7]; // "x" .. "qw"

// Memory for key_count keys (1..MAX_KEYS), the rest filled in. NULL with MEMORY.
DipCamPath *dip_campath_allocate(size_t key_count, int64_t period_ns, const char *name,
                                 DipError *err);

// Sets what follows from the keys. They must be unit and aligned.
void dip_campath_finish(DipCamPath *path);

// Component 0..6 of a key, in the files' order.
double dip_campath_component(const DipCamKey *key, int index);

bool dip_campath_is_unit(const double q[4]);
double dip_campath_dot(const double a[4], const double b[4]);

// Checks ranges, then normalises and aligns key->orientation with the key before (NULL: the first).
// Errors carry name and line.
bool dip_campath_admit(DipCamKey *key, const DipCamKey *before, const char *name, int line,
                       DipError *err);

bool dip_campath_parse_text(const char *text, size_t size_bytes, const char *name,
                            DipCamPath **path, DipError *err);
bool dip_campath_parse_binary(const unsigned char *bytes, size_t size_bytes, const char *name,
                              DipCamPath **path, DipError *err);

// The caller checks the stream for errors afterwards.
void dip_campath_write_text(const DipCamPath *path, FILE *stream);
void dip_campath_write_binary(const DipCamPath *path, FILE *stream);

#endif
