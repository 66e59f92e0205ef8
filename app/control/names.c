// Names of requests, topics and parts.
#include "app/control/request.h"

#include "renderer/base/assert.h"

#define NAME_OF(name, NAME) #name,

const char *dip_control_verb_name(int verb) {
    static const char *const names[] = {DIP_CONTROL_VERB_LIST(NAME_OF)};
    DIP_ASSERT(verb >= 0 && verb < DIP_CONTROL_VERB_COUNT);
    return names[verb];
}

const char *dip_control_topic_name(int topic) {
    static const char *const names[] = {DIP_CONTROL_TOPIC_LIST(NAME_OF)};
    DIP_ASSERT(topic >= 0 && topic < DIP_CONTROL_TOPIC_COUNT);
    return names[topic];
}

const char *dip_control_part_name(int part) {
    static const char *const names[] = {DIP_CONTROL_PART_LIST(NAME_OF)};
    DIP_ASSERT(part >= 0 && part < DIP_CONTROL_PART_COUNT);
    return names[part];
}
