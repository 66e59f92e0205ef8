// Reads and writes the binary format of camera paths.
#include "campaths/campath_private.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

const unsigned char dip_campath_magic[8] = {0x89, 'D', 'I', 'P', 'B', 'T', 'H', '\n'};

static uint64_t read_little_endian(const unsigned char *bytes, int count) {
    uint64_t value = 0;
    for (int i = count - 1; i >= 0; i--) {
        value = value << 8 | bytes[i];
    }
    return value;
}

static double read_double(const unsigned char *bytes) {
    const uint64_t bits = read_little_endian(bytes, 8);
    double value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

static bool check_header(const unsigned char *bytes, size_t size_bytes, const char *name,
                         DipError *err) {
    const size_t compared = size_bytes < 8 ? size_bytes : 8;
    if (memcmp(bytes, dip_campath_magic, compared) != 0) {
        return dip_error_set(
            err, DIP_ERROR_FORMAT, name, 0, "magic",
            "at byte 0: these are not the magic bytes of a .bth file, accepted 89 'DIPBTH' 0A");
    }
    if (size_bytes < DIP_CAMPATH_HEADER_BYTES) {
        return dip_error_set(
            err, DIP_ERROR_TRUNCATED, name, 0, "header",
            "at byte %zu: the file ends within its header, accepted a header of %d bytes",
            size_bytes, DIP_CAMPATH_HEADER_BYTES);
    }
    const unsigned version = (unsigned)read_little_endian(bytes + 8, 4);
    if (version != DIP_CAMPATH_VERSION) {
        return dip_error_set(err, DIP_ERROR_FORMAT, name, 0, "version",
                             "at byte 8: version %u, accepted %d", version, DIP_CAMPATH_VERSION);
    }
    const unsigned count = (unsigned)read_little_endian(bytes + 12, 4);
    if (count < 1 || count > DIP_CAMPATH_MAX_KEYS) {
        return dip_error_set(err, DIP_ERROR_RANGE, name, 0, "keys",
                             "at byte 12: %u keys, accepted 1..%d", count, DIP_CAMPATH_MAX_KEYS);
    }
    const int64_t period_ns = (int64_t)read_little_endian(bytes + 16, 8);
    if (period_ns < DIP_CAMPATH_MIN_PERIOD_NS || period_ns > DIP_CAMPATH_MAX_PERIOD_NS) {
        return dip_error_set(err, DIP_ERROR_RANGE, name, 0, "period",
                             "at byte 16: %lld ns is out of range, accepted %lld..%lld",
                             (long long)period_ns, (long long)DIP_CAMPATH_MIN_PERIOD_NS,
                             (long long)DIP_CAMPATH_MAX_PERIOD_NS);
    }
    const uint64_t expected = DIP_CAMPATH_HEADER_BYTES + (uint64_t)count * DIP_CAMPATH_KEY_BYTES;
    if (size_bytes != expected) {
        const bool is_short = size_bytes < expected;
        return dip_error_set(err, is_short ? DIP_ERROR_TRUNCATED : DIP_ERROR_OVERSIZED, name, 0,
                             "keys", "at byte %llu: %s, accepted %llu bytes for %u keys",
                             (unsigned long long)(is_short ? size_bytes : expected),
                             is_short ? "the file ends too early"
                                      : "the file goes on after the last key",
                             (unsigned long long)expected, count);
    }
    return true;
}

static bool check_key(const DipCamKey *key, const DipCamKey *before, size_t offset,
                      const char *name, DipError *err) {
    for (int i = 0; i < 7; i++) {
        const double limit = i < 3 ? DIP_CAMPATH_MAX_POSITION : 1.0 + DIP_CAMPATH_UNIT_TOLERANCE;
        const double value = dip_campath_component(key, i);
        if (!(fabs(value) <= limit)) {
            return dip_error_set(err, DIP_ERROR_RANGE, name, 0, dip_campath_key_names[i],
                                 "at byte %zu: %.9g is out of range, accepted %g..%g",
                                 offset + 8 * (size_t)i, value, -limit, limit);
        }
    }
    const char *reason = NULL;
    if (!dip_campath_is_unit(key->orientation)) {
        reason = "the quaternion is not of unit length, accepted a normalised one";
    } else if (before && dip_campath_dot(before->orientation, key->orientation) < 0.0) {
        reason =
            "the quaternion is on the other hemisphere than the one before, accepted its negative";
    }
    return !reason || dip_error_set(err, DIP_ERROR_RANGE, name, 0, "qx qy qz qw", "at byte %zu: %s",
                                    offset + 24, reason);
}

bool dip_campath_parse_binary(const unsigned char *bytes, size_t size_bytes, const char *name,
                              DipCamPath **path, DipError *err) {
    *path = NULL;
    if (!check_header(bytes, size_bytes, name, err)) {
        return false;
    }
    const size_t count = (size_t)read_little_endian(bytes + 12, 4);
    const int64_t period_ns = (int64_t)read_little_endian(bytes + 16, 8);
    DipCamPath *made = dip_campath_allocate(count, period_ns, name, err);
    if (!made) {
        return false;
    }
    for (size_t k = 0; k < count; k++) {
        const size_t offset = DIP_CAMPATH_HEADER_BYTES + k * DIP_CAMPATH_KEY_BYTES;
        DipCamKey *key = &made->keys[k];
        for (int i = 0; i < 7; i++) {
            const double value = read_double(bytes + offset + 8 * i);
            *(i < 3 ? &key->position_world[i] : &key->orientation[i - 3]) = value;
        }
        if (!check_key(key, k ? key - 1 : NULL, offset, name, err)) {
            free(made);
            return false;
        }
    }
    dip_campath_finish(made);
    *path = made;
    return true;
}

static void put_little_endian(unsigned char *bytes, int count, uint64_t value) {
    for (int i = 0; i < count; i++) {
        bytes[i] = (unsigned char)(value >> (8 * i));
    }
}

void dip_campath_write_binary(const DipCamPath *path, FILE *stream) {
    unsigned char header[DIP_CAMPATH_HEADER_BYTES];
    memcpy(header, dip_campath_magic, sizeof dip_campath_magic);
    put_little_endian(header + 8, 4, DIP_CAMPATH_VERSION);
    put_little_endian(header + 12, 4, path->key_count);
    put_little_endian(header + 16, 8, (uint64_t)path->period_ns);
    fwrite(header, 1, sizeof header, stream);
    for (size_t k = 0; k < path->key_count; k++) {
        unsigned char bytes[DIP_CAMPATH_KEY_BYTES];
        for (int i = 0; i < 7; i++) {
            const double value = dip_campath_component(&path->keys[k], i);
            uint64_t bits;
            memcpy(&bits, &value, sizeof bits);
            put_little_endian(bytes + 8 * i, 8, bits);
        }
        fwrite(bytes, 1, sizeof bytes, stream);
    }
}
