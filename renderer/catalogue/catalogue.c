// The list of topics, in the order of docs/stability.md. Each topic has a file rows_<name>.c. To
// add one, add it here and to CMakeLists.txt.
#include "renderer/catalogue/stability.h"

// clang-format off
#define TOPIC_LIST(X) \
    X(view)           \
    X(turns)          \
    X(raster)         \
    X(clipping)       \
    X(distance)       \
    X(texture)        \
    X(footprint)      \
    X(surface)        \
    X(effects)        \
    X(water)          \
    X(reference)      \
    X(time)           \
    X(motion)         \
    X(parallel)       \
    X(numbers)
// clang-format on

#define DECLARE_TOPIC(name) extern const StabilityTopic stability_##name;
TOPIC_LIST(DECLARE_TOPIC)
#undef DECLARE_TOPIC

const StabilityTopic *const stability_topics[] = {
#define TOPIC_ADDRESS(name) &stability_##name,
    TOPIC_LIST(TOPIC_ADDRESS)
#undef TOPIC_ADDRESS
};

const size_t stability_topic_count = sizeof stability_topics / sizeof *stability_topics;
