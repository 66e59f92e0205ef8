// Reading RAPL counters from files.
#include "app/cost/axes/axes_energy.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_ZONES = 256 };

// Reads the first line of a small file, without its end. Returns false and leaves errno on failure.
static bool read_line(const char *file, char *text, int size) {
    FILE *in = fopen(file, "r");
    if (!in) {
        return false;
    }
    errno = EIO; // Of an empty file.
    const bool read = fgets(text, size, in) != NULL;
    fclose(in);
    text[read ? strcspn(text, "\n") : 0] = '\0';
    return read;
}

static bool read_number(const char *file, uint64_t *number) {
    char text[32];
    if (!read_line(file, text, sizeof text)) {
        return false;
    }
    char *end;
    errno = 0;
    *number = strtoull(text, &end, 10);
    if (errno == 0 && (end == text || *end || text[0] == '-')) {
        errno = EINVAL;
    }
    return errno == 0;
}

// Writes the name of a zone's file. Returns false if it does not fit.
static bool zone_file(char file[PATH_MAX], const char *folder, int zone, const char *name) {
    const int length = snprintf(file, PATH_MAX, "%s/intel-rapl:%d/%s", folder, zone, name);
    return length > 0 && length < PATH_MAX;
}

static void refuse(DipEnergyMeter *meter, const char *file) {
    meter->count = 0;
    snprintf(meter->text, sizeof meter->text, "%.180s cannot be read: %.60s", file,
             strerror(errno));
}

// Adds the package of a zone. Returns false if the machine does not tell.
static bool add_package(DipEnergyMeter *meter, const char *folder, int zone) {
    char file[PATH_MAX];
    uint64_t now_uj;
    if (meter->count == DIP_ENERGY_MAX_PACKAGES) {
        meter->count = 0;
        snprintf(meter->text, sizeof meter->text, "the machine has more than %d packages",
                 DIP_ENERGY_MAX_PACKAGES);
        return false;
    }
    DipEnergyPackage *package = &meter->packages[meter->count];
    if (!zone_file(file, folder, zone, "max_energy_range_uj") ||
        !read_number(file, &package->range_uj)) {
        refuse(meter, file);
        return false;
    }
    if (!zone_file(package->file, folder, zone, "energy_uj") ||
        !read_number(package->file, &now_uj)) {
        refuse(meter, package->file);
        return false;
    }
    meter->count++;
    return true;
}

void dip_energy_open(DipEnergyMeter *meter, const char *folder) {
    char file[PATH_MAX], name[32];
    memset(meter, 0, sizeof *meter);
    for (int zone = 0; zone < MOST_ZONES; zone++) {
        if (zone_file(file, folder, zone, "name") && read_line(file, name, sizeof name) &&
            strncmp(name, "package-", 8) == 0 && !add_package(meter, folder, zone)) {
            return;
        }
    }
    if (meter->count == 0) {
        snprintf(meter->text, sizeof meter->text, "%.180s has no counters of packages", folder);
        return;
    }
    snprintf(meter->text, sizeof meter->text, "%d package%s in %.180s", meter->count,
             meter->count == 1 ? "" : "s", folder);
}

bool dip_energy_read(const DipEnergyMeter *meter, DipEnergyReading *reading) {
    if (meter->read) {
        return meter->read(meter->context, reading);
    }
    bool read = meter->count > 0;
    for (int i = 0; read && i < meter->count; i++) {
        read = read_number(meter->packages[i].file, &reading->uj[i]);
    }
    return read;
}

uint64_t dip_energy_between_uj(const DipEnergyMeter *meter, const DipEnergyReading *before,
                               const DipEnergyReading *after) {
    uint64_t sum = 0;
    for (int i = 0; i < meter->count; i++) {
        const uint64_t from = before->uj[i], to = after->uj[i];
        sum += to >= from ? to - from : to + (meter->packages[i].range_uj - from);
    }
    return sum;
}
