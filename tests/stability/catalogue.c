// The list of topics. To add a topic, declare its table and add it here.
#include "tests/stability/stability.h"

extern const StabilityTopic stability_numbers;
extern const StabilityTopic stability_surface;
extern const StabilityTopic stability_view;

const StabilityTopic *const stability_topics[] = {
    &stability_numbers,
    &stability_view,
    &stability_surface,
};

const size_t stability_topic_count = sizeof stability_topics / sizeof *stability_topics;
