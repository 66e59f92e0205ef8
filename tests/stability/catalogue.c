// The list of topics. To add a topic, declare its table and add it here.
#include "tests/stability/stability.h"

extern const StabilityTopic stability_numbers;
extern const StabilityTopic stability_raster;
extern const StabilityTopic stability_texture;
extern const StabilityTopic stability_view;
extern const StabilityTopic stability_time;
extern const StabilityTopic stability_parallel;

const StabilityTopic *const stability_topics[] = {
    &stability_raster,   &stability_texture, &stability_time,
    &stability_parallel, &stability_numbers, &stability_view,
};

const size_t stability_topic_count = sizeof stability_topics / sizeof *stability_topics;
