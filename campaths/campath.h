// A camera path: keys of position and orientation at equal steps of time, flown in a closed loop.
//
// Key i stands at time i * period; the last key is followed by the first, so a path of N keys has
// the duration N * period and comes back to where it began. Between keys positions are
// interpolated linearly (LERP), orientations along the shortest arc at constant speed (SLERP). One
// key alone is a still camera. Conventions of space are those of renderer/scene/pose.h. The field
// of view is not part of a path.
//
// Text, `.pth`. ASCII, '\n' or '\r\n', '#' begins a comment anywhere, empty lines do not count,
// tokens are separated by spaces or tabs:
//
//     diptych-path 1              the format and its version, on the first line that counts
//     period 0.25                 seconds from key to key, once, before the keys
//     x y z qx qy qz qw           one key per line: position in metres, quaternion
//
// Numbers are decimal, finite, with '.' in every locale. The period is rounded to nanoseconds.
// Quaternions need not be of unit length (1e-6..1e6 is accepted); loading normalises them, unless
// they are already within DIP_CAMPATH_UNIT_TOLERANCE, and negates those that lie on the other
// hemisphere than the key before. Both leave alone what they made themselves, so that loading,
// saving and converting any number of times, through either format, keeps every bit.
//
// Binary, `.bth`. All numbers little-endian on every host:
//
//     byte  size  content
//        0     8  magic 89 44 49 50 42 54 48 0A ("\x89" "DIPBTH" "\n")
//        8     4  version, unsigned: 1
//       12     4  key count N, unsigned: 1..DIP_CAMPATH_MAX_KEYS
//       16     8  period in nanoseconds, signed: DIP_CAMPATH_MIN_PERIOD_NS..MAX
//       24  56*N  keys: x y z qx qy qz qw as IEEE 754 binary64, each; quaternions of unit length
//                 and each on the hemisphere of the one before (dot product >= 0)
//
// and nothing after the keys. docs/campaths.md shows a file byte by byte.
#ifndef DIP_CAMPATHS_CAMPATH_H
#define DIP_CAMPATHS_CAMPATH_H

#include "renderer/base/error.h"
#include "renderer/scene/pose.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum {
    DIP_CAMPATH_VERSION = 1,
    DIP_CAMPATH_MAX_KEYS = 1000000,
    DIP_CAMPATH_MAX_LINE = 1000, // characters of a text line
    DIP_CAMPATH_HEADER_BYTES = 24,
    DIP_CAMPATH_KEY_BYTES = 56
};

#define DIP_CAMPATH_MAX_FILE_BYTES ((size_t)256 << 20)
#define DIP_CAMPATH_MAX_POSITION   1e9                    // metres, either sign
#define DIP_CAMPATH_MIN_PERIOD_NS  INT64_C(1000)          // a microsecond
#define DIP_CAMPATH_MAX_PERIOD_NS  INT64_C(3600000000000) // an hour
#define DIP_CAMPATH_UNIT_TOLERANCE 1e-14                  // of the squared length of a quaternion

typedef struct DipCamKey {
    double position_world[3];
    double orientation[4]; // x, y, z, w
} DipCamKey;

// Immutable once made, so that any number of threads may sample it.
typedef struct DipCamPath DipCamPath;

// What `diptych path info` shows.
typedef struct DipCamPathInfo {
    size_t key_count;
    int64_t period_ns;
    int64_t duration_ns; // key_count * period_ns
    double min_world[3]; // box around the positions
    double max_world[3];
    double length_m;           // of the whole loop
    double max_speed_m_per_s;  // over any one step
    double max_turn_deg_per_s; // likewise
} DipCamPathInfo;

// Makes a path from keys under the rules of the text format; keys are copied. Fails with RANGE
// (count, period, a number), MEMORY.
bool dip_campath_create(const DipCamKey *keys, size_t key_count, int64_t period_ns,
                        DipCamPath **path, DipError *err);

// Accepts NULL and nulls the pointer.
void dip_campath_destroy(DipCamPath **path);

// Reads either format, told apart by content. On failure *path is NULL and *err names file, line
// (text) or byte (binary, in the message), key and what is accepted. Codes: IO, FORMAT (no path
// file, another version, a malformed line), TYPE (no number), RANGE, MISSING (header, period or
// keys), CONFLICT (a second period), TRUNCATED, OVERSIZED, MEMORY.
bool dip_campath_load(const char *file, DipCamPath **path, DipError *err);

// As above from memory; name stands for the file in messages.
bool dip_campath_parse(const void *bytes, size_t size_bytes, const char *name, DipCamPath **path,
                       DipError *err);

// Each replaces the file. Fails with IO; a file half written is then removed.
bool dip_campath_save_pth(const DipCamPath *path, const char *file, DipError *err);
bool dip_campath_save_bth(const DipCamPath *path, const char *file, DipError *err);

DipCamPathInfo dip_campath_info(const DipCamPath *path);
DipCamKey dip_campath_key(const DipCamPath *path, size_t index); // index < key_count

// Fills position and orientation at any time, also a negative one; fov_y_deg is left alone. The
// time is reduced to the duration in integers: times a duration apart give the same bits.
void dip_campath_sample(const DipCamPath *path, int64_t time_ns, DipPose *pose);

// An orbit about a model's bounding box: a full turn at constant speed, from +Z over +X, looking at
// the box's middle from 15 degrees above it, as near as keeps the whole box in the picture.
typedef struct DipCamOrbitDef {
    double min_world[3]; // min <= max, within DIP_CAMPATH_MAX_POSITION / 100
    double max_world[3];
    double fov_y_deg;    // 1..170
    double aspect;       // width / height of the picture, 0.01..100
    int64_t duration_ns; // of a turn, rounded down to a multiple of 100 ns
} DipCamOrbitDef;

// 20 s, 50 degrees, 4:3, a unit cube about the origin.
DipCamOrbitDef dip_campath_default_orbit(void);
bool dip_campath_orbit(const DipCamOrbitDef *def, DipCamPath **path, DipError *err);

#endif
