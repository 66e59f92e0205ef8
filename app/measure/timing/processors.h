// Chooses the processors on which the threads of a process draw timed frames.
//
// Processors of one machine are not equally fast: some machines have fast and slow cores, two
// processors may share one core, and other programs or other virtual machines slow some of them
// down. An operating system tends to leave a thread where it ran before. If a frame needs fewer
// threads than there are processors, two programs may thus draw on different processors during a
// whole measurement, and the ratio of their times is wrong however many rounds they draw in turn.
// With one thread on a virtual machine of two processors, ratios of a program to itself lay between
// 0.68 and 1.5, and between 0.99 and 1.03 with both on the same processor.
#ifndef DIP_APP_MEASURE_TIMING_PROCESSORS_H
#define DIP_APP_MEASURE_TIMING_PROCESSORS_H

#include "renderer/base/api.h"

#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

// Sorts processors by how suitable they are for a frame with few threads, the best one first: one
// processor of each core comes before the others of the same core, and faster ones come before
// slower ones. Equally suitable ones come in the order of their numbers, those from number `from`
// on first. `folder` is Linux' folder of processors, /sys/devices/system/cpu. Processors about
// which it says nothing are cores of their own, slower than all others.
DIP_API void dip_processors_sort(const char *folder, int from, int *processors, int count);

// Lets all threads that a process of the same user has at this moment run on as many processors as
// `threads` says: the first ones, in the order of dip_processors_sort, of those that the thread
// which called this function first might use then. If `threads` is 0 or at least the number of
// these, they may run on all of these. All calls of one process choose the same processors;
// measurements of several processes probably choose different ones, since `from` follows from the
// number of the calling process. `pid` may be that of the calling process. Returns whether all
// threads may now run where they should, which is false where the system cannot do this.
// Thread-safe.
DIP_API bool dip_processors_confine(long pid, int threads);

#ifdef __cplusplus
}
#endif

#endif
