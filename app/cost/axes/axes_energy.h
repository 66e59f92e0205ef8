// The energy that the processor's packages take, where the machine tells (RAPL).
//
// Linux shows the counters as files: FOLDER/intel-rapl:N/energy_uj has microjoules, on processors
// of Intel and AMD. Each counter begins again at 0 after max_energy_range_uj. Only the packages
// themselves count (their file `name` is package-0, package-1, ...); the parts of a package
// (intel-rapl:0:0) and the whole platform (psys) are left out. On most systems only root may read
// the counters.
#ifndef DIP_APP_COST_AXES_AXES_ENERGY_H
#define DIP_APP_COST_AXES_AXES_ENERGY_H

#include <limits.h>
#include <stdbool.h>
#include <stdint.h>

#define DIP_ENERGY_FOLDER "/sys/class/powercap"

enum { DIP_ENERGY_MAX_PACKAGES = 16, DIP_ENERGY_TEXT = 288 };

typedef struct DipEnergyPackage {
    char file[PATH_MAX]; // Its energy_uj.
    uint64_t range_uj;   // Greatest value of the counter.
} DipEnergyPackage;

// The counters at one time.
typedef struct DipEnergyReading {
    uint64_t uj[DIP_ENERGY_MAX_PACKAGES];
} DipEnergyReading;

typedef struct DipEnergyMeter {
    DipEnergyPackage packages[DIP_ENERGY_MAX_PACKAGES];
    int count;                  // Number of packages; 0: the machine does not tell.
    char text[DIP_ENERGY_TEXT]; // Where the energy comes from, or why the machine does not tell.
    // Reads the counters instead of the files, for tests. NULL: the files are read.
    bool (*read)(void *context, DipEnergyReading *reading);
    void *context;
} DipEnergyMeter;

// Finds the counters in a folder, usually DIP_ENERGY_FOLDER. If any package's counter cannot be
// read, or if there are more packages than fit, the machine does not tell.
void dip_energy_open(DipEnergyMeter *meter, const char *folder);

// Reads all counters. Returns false if there are none, or if one cannot be read any more.
bool dip_energy_read(const DipEnergyMeter *meter, DipEnergyReading *reading);

// Returns the energy between two readings, the sum of all packages, in microjoules. A counter that
// went down has begun again once.
uint64_t dip_energy_between_uj(const DipEnergyMeter *meter, const DipEnergyReading *before,
                               const DipEnergyReading *after);

#endif
