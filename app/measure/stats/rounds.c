// Which frames a round draws.
#include "app/measure/stats/rounds.h"

#include "app/measure/internal/random.h"
#include "renderer/base/assert.h"

void dip_rounds_deal(int frames, int rounds, int copies, uint64_t seed, int *round_of) {
    DIP_ASSERT(frames > 0 && rounds > 0 && copies > 0 && copies <= rounds);
    uint64_t random = seed * UINT64_C(0x9e3779b97f4a7c15) + UINT64_C(0x632be59bd9b4e019);
    (void)random;
    (void)round_of;
}
