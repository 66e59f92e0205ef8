// Fuzzes the reader of settings as text, "aa=4,af=16". Settings that were read give the same
// settings when they are written and read again.
#include "renderer/scene/quality.h"
#include "tests/fuzz/fuzz.h"

#include <stdlib.h>
#include <string.h>

static void check_accepted(const DipQuality *quality) {
    FUZZ_CHECK(dip_quality_check(quality, NULL));
    char text[256];
    const size_t length = dip_quality_format(quality, text, sizeof text);
    FUZZ_CHECK(length == strlen(text));
    DipQuality again;
    FUZZ_CHECK(dip_quality_parse(text, &again, NULL));
    FUZZ_CHECK(memcmp(quality, &again, sizeof again) == 0);
    const int samples = dip_quality_sample_count(quality);
    FUZZ_CHECK(samples % dip_quality_samples_per_group(quality) == 0);
}

static void check_refused(const DipQuality *quality, const DipQuality *before,
                          const DipError *err) {
    FUZZ_CHECK(memcmp(quality, before, sizeof *before) == 0);
    FUZZ_CHECK(err->code != DIP_ERROR_NONE && err->message[0]);
}

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size_bytes) {
    uint8_t *text = fuzz_copy(bytes, size_bytes, true);
    DipQuality before;
    memset(&before, 0x5a, sizeof before);
    DipQuality quality = before;
    DipError err = {0};
    if (dip_quality_parse((const char *)text, &quality, &err)) {
        check_accepted(&quality);
    } else {
        check_refused(&quality, &before, &err);
    }
    free(text);
    return 0;
}
