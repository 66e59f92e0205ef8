// Fuzzes the reader of the control channel's requests. A request that is read keeps to the ranges
// that its header states, and is read again from its line; a refusal says why in UTF-8.
#include "app/control/request.h"
#include "tests/fuzz/fuzz.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static bool ends(const char *text, size_t size_bytes) {
    return memchr(text, '\0', size_bytes) != NULL;
}

static void check_texts(const DipControlRequest *request) {
    FUZZ_CHECK(ends(request->id.text, sizeof request->id.text));
    FUZZ_CHECK(ends(request->settings, sizeof request->settings));
    FUZZ_CHECK(ends(request->change, sizeof request->change));
    FUZZ_CHECK(ends(request->category, sizeof request->category));
    FUZZ_CHECK(ends(request->name, sizeof request->name));
    FUZZ_CHECK(ends(request->file, sizeof request->file));
}

// A change of settings gives valid settings or explains why not.
static void check_change(const char *change) {
    const DipQuality before = dip_quality_default();
    DipQuality quality = before;
    DipError err = {0};
    if (dip_control_change_settings(&before, change, &quality, &err)) {
        FUZZ_CHECK(dip_quality_check(&quality, NULL));
    } else {
        FUZZ_CHECK(memcmp(&quality, &before, sizeof before) == 0);
        FUZZ_CHECK(err.message[0]);
    }
}

static void check_read(const DipControlRequest *request) {
    DipQuality quality;
    check_texts(request);
    FUZZ_CHECK(request->verb >= 0 && request->verb < DIP_CONTROL_VERB_COUNT);
    FUZZ_CHECK(request->time_s >= 0.0 && request->time_s <= 86400.0);
    FUZZ_CHECK(request->width >= 0 && request->width <= DIP_CONTROL_MAX_SIZE_PX);
    FUZZ_CHECK(request->x >= 0 && request->x < DIP_CONTROL_MAX_SIZE_PX);
    FUZZ_CHECK(request->topics >> DIP_CONTROL_TOPIC_COUNT == 0);
    FUZZ_CHECK(request->parts >> DIP_CONTROL_PART_COUNT == 0);
    FUZZ_CHECK(fabs(request->id.number) <= 9007199254740992.0);
    if (request->verb == DIP_CONTROL_SET) {
        FUZZ_CHECK(request->panes >= 1 && request->panes <= 3);
        FUZZ_CHECK((request->settings[0] != '\0') != (request->change[0] != '\0'));
        FUZZ_CHECK(!request->settings[0] || dip_quality_parse(request->settings, &quality, NULL));
        check_change(request->change);
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size_bytes) {
    uint8_t *line = fuzz_copy(bytes, size_bytes, false);
    static DipControlRequest request, again;
    DipError err = {0};
    if (dip_control_request_read((const char *)line, size_bytes, &request, &err)) {
        check_read(&request);
        FUZZ_CHECK(dip_control_request_read((const char *)line, size_bytes, &again, NULL));
        FUZZ_CHECK(memcmp(&request, &again, sizeof again) == 0);
    } else {
        check_texts(&request);
        FUZZ_CHECK(err.code != DIP_ERROR_NONE && err.message[0]);
    }
    free(line);
    return 0;
}
