// A camera path: keys of position and orientation at equal steps of time, flown in a closed loop.
//
// Key i is reached at time i * period. The first key follows the last one, so a path of N keys
// lasts N * period and ends where it began. Between keys, positions are interpolated linearly
// (LERP) and orientations along the shortest arc at constant speed (SLERP). A path with a single
// key is a still camera. renderer/scene/pose.h defines the coordinate system. The field of view is
// not part of a path.
//
// Text format, `.pth`. ASCII; lines end in '\n' or '\r\n'; '#' begins a comment anywhere; empty
// lines are ignored; spaces or tabs separate tokens:
//
//     diptych-path 1              format and version, on the first line with a token
//     period 0.25                 seconds from key to key, once, before the keys
//     x y z qx qy qz qw           one key per line: position in metres, quaternion
//
// Numbers are decimal and finite, with '.' in every locale. The period is rounded to nanoseconds.
// Quaternions may have any length from 1e-6 to 1e6. Loading normalises a quaternion unless its
// squared length is within DIP_CAMPATH_UNIT_TOLERANCE of 1, and negates it if its dot product with
// the quaternion before it is negative. If a path was loaded and saved before, loading it again
// changes no key. So a path keeps every bit when it is loaded, saved and converted any number of
// times, in either format.
//
// Binary format, `.bth`. All numbers are little-endian on every host:
//
//     byte  size  content
//        0     8  magic 89 44 49 50 42 54 48 0A ("\x89" "DIPBTH" "\n")
//        8     4  version, unsigned: 1
//       12     4  key count N, unsigned: 1..DIP_CAMPATH_MAX_KEYS
//       16     8  period in nanoseconds, signed: DIP_CAMPATH_MIN_PERIOD_NS..MAX
//       24  56*N  keys: x y z qx qy qz qw, each an IEEE 754 binary64; quaternions of unit length,
//                 each on the hemisphere of the one before it (dot product >= 0)
//
// The file ends after the keys. docs/campaths.md shows a file byte by byte.
//
// Threads: a DipCamPath never changes after its creation, so any number of threads may read it.
// Functions that create, load or save paths may run at the same time on different paths and files.
#ifndef DIP_CAMPATHS_CAMPATH_H
#define DIP_CAMPATHS_CAMPATH_H

#include "renderer/base/api.h"
#include "renderer/base/error.h"
#include "renderer/scene/pose.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

enum {
    DIP_CAMPATH_VERSION = 1,
    DIP_CAMPATH_MAX_KEYS = 1000000,
    DIP_CAMPATH_MAX_LINE = 1000, // bytes in a line of text
    DIP_CAMPATH_HEADER_BYTES = 24,
    DIP_CAMPATH_KEY_BYTES = 56
};

#define DIP_CAMPATH_MAX_FILE_BYTES ((size_t)256 << 20)
#define DIP_CAMPATH_MAX_POSITION   1e9                    // metres, positive or negative
#define DIP_CAMPATH_MIN_PERIOD_NS  INT64_C(1000)          // a microsecond
#define DIP_CAMPATH_MAX_PERIOD_NS  INT64_C(3600000000000) // an hour
#define DIP_CAMPATH_UNIT_TOLERANCE 1e-14                  // allowed error of a squared length

typedef struct DipCamKey {
    double position_world[3];
    double orientation[4]; // quaternion x, y, z, w
} DipCamKey;

typedef struct DipCamPath DipCamPath;

// Statistics of a path, as `diptych path info` shows them.
typedef struct DipCamPathInfo {
    size_t key_count;
    int64_t period_ns;
    int64_t duration_ns;       // key_count * period_ns
    double min_world[3];       // lowest corner of the box around the positions
    double max_world[3];       // highest corner of that box
    double length_m;           // length of the whole loop
    double max_speed_m_per_s;  // greatest speed between two keys
    double max_turn_deg_per_s; // greatest speed of turning between two keys
} DipCamPathInfo;

// Creates a path from keys, which must follow the rules of the text format. The keys are copied.
// The caller owns *path and destroys it with dip_campath_destroy. On failure *path is NULL. Codes:
// RANGE (count, period or a number), MEMORY.
DIP_API bool dip_campath_create(const DipCamKey *keys, size_t key_count, int64_t period_ns,
                                DipCamPath **path, DipError *err);

// Destroys the path and sets the pointer to NULL. Accepts NULL and a pointer to NULL.
DIP_API void dip_campath_destroy(DipCamPath **path);

// Loads either format; the file's content decides which, not its name. The caller owns *path. On
// failure *path is NULL and *err names the file, the line (text) or byte (binary, in the message),
// the key, and what is accepted. Codes: IO, FORMAT (not a path file, another version, a malformed
// line), TYPE (not a number), RANGE, MISSING (header, period or keys), CONFLICT (a second period),
// TRUNCATED, OVERSIZED, MEMORY.
DIP_API bool dip_campath_load(const char *file, DipCamPath **path, DipError *err);

// Like dip_campath_load, but reads the file's bytes from memory. Messages call the file `name`.
DIP_API bool dip_campath_parse(const void *bytes, size_t size_bytes, const char *name,
                               DipCamPath **path, DipError *err);

// Each function saves the path in one format and replaces an existing file. If it fails (IO), it
// removes what it has written.
DIP_API bool dip_campath_save_pth(const DipCamPath *path, const char *file, DipError *err);
DIP_API bool dip_campath_save_bth(const DipCamPath *path, const char *file, DipError *err);

// Examines every key. dip_campath_span_ns tells the duration at once.
DIP_API DipCamPathInfo dip_campath_info(const DipCamPath *path);
DIP_API DipCamKey dip_campath_key(const DipCamPath *path, size_t index); // index < key_count

// Sets the pose's position and orientation to the path's at a given time. Leaves fov_y_deg
// unchanged. The time may be negative. It is an integer and is taken modulo the duration, so times
// one duration apart give the same bits.
DIP_API void dip_campath_sample(const DipCamPath *path, int64_t time_ns, DipPose *pose);

// What happens at the end of a path, as X(name, "what it means", for the help). A path that is not
// meant as a loop jumps from its last key to its first within one period; `once` and `back` do not
// fly that step.
#define DIP_CAMPATH_END_LIST(X)                                                                    \
    X(loop, "flies from the last key to the first one and on from there")                          \
    X(once, "stops at the last key")                                                               \
    X(back, "flies the path backwards to the first key, then forwards again, and so on")

typedef enum DipCamPathEnd {
#define DIP_CAMPATH_END_ENUM(name, text) DIP_CAMPATH_END_##name,
    DIP_CAMPATH_END_LIST(DIP_CAMPATH_END_ENUM)
#undef DIP_CAMPATH_END_ENUM
        DIP_CAMPATH_END_COUNT
} DipCamPathEnd;

// The ends by name: "loop", "once", "back".
extern DIP_API const char *const dip_campath_end_names[DIP_CAMPATH_END_COUNT];

// Returns the time from 0 to the last key, or to the path's duration for a loop, at which the path
// has the pose that it shows at time_ns. `once` shows the first key at negative times.
DIP_API int64_t dip_campath_time_at_end(const DipCamPath *path, DipCamPathEnd end, int64_t time_ns);

// Returns how long the path takes until it repeats itself, or until it stops. A path with a single
// key that does not loop takes no time.
DIP_API int64_t dip_campath_span_ns(const DipCamPath *path, DipCamPathEnd end);

// An orbit about a model's bounding box: one full turn at constant speed, from +Z over +X. The
// camera looks at the middle of the box from 15 degrees above the horizon, from the shortest
// distance that keeps the whole silhouette in the picture all the way round.
typedef struct DipCamOrbitDef {
    double min_world[3]; // min <= max, within DIP_CAMPATH_MAX_POSITION / 100
    double max_world[3];
    double fov_y_deg;    // vertical field of view, 1..170
    double aspect;       // width / height of the picture, 0.01..100
    int64_t duration_ns; // time of a turn; rounded down to a multiple of 100 ns
    // The silhouette: the box is divided into slices of equal height, from the lowest on, and each
    // slice has the greatest distance of its content from the vertical axis through the middle of
    // the box; a negative number for an empty slice. NULL: the whole box is kept in the picture.
    const double *radii;
    int radius_count;
} DipCamOrbitDef;

// Returns an orbit of 20 s about a unit cube at the origin, with a field of view of 50 degrees and
// an aspect of 4:3.
DIP_API DipCamOrbitDef dip_campath_default_orbit(void);

// Creates the path of an orbit, which the caller owns. On failure *path is NULL. Codes: RANGE (box,
// fov, aspect or period), MEMORY.
DIP_API bool dip_campath_orbit(const DipCamOrbitDef *def, DipCamPath **path, DipError *err);

#ifdef __cplusplus
}
#endif

#endif
