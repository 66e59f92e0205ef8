// Changes some settings of a pane and keeps the others.
#include "app/control/request.h"

#include <stdio.h>
#include <string.h>

// Returns whether a text of settings, "aa=4,af=16", has a part for a key.
static bool names_key(const char *text, const char *key) {
    const size_t length = strlen(key);
    while (*text) {
        const size_t part = strcspn(text, ",");
        if (strcspn(text, "=,") == length && strncmp(text, key, length) == 0) {
            return true;
        }
        text += part + (text[part] == ',');
    }
    return false;
}

// Writes the old steps of all settings that the change does not name, and then the change. The
// reader of settings then finds every mistake.
bool dip_control_change_settings(const DipQuality *from, const char *change, DipQuality *to,
                                 DipError *err) {
    char text[DIP_CONTROL_TEXT_SIZE + 256];
    size_t length = 0;
    for (int s = 0; s < DIP_SETTING_COUNT; ++s) {
        const DipSettingInfo *info = dip_setting_info((DipSetting)s);
        if (!names_key(change, info->key) && length < sizeof text) {
            length += (size_t)snprintf(text + length, sizeof text - length, "%s=%s,", info->key,
                                       info->steps[from->step[s]]);
        }
    }
    if (length + strlen(change) >= sizeof text) {
        return dip_error_set(err, DIP_ERROR_OVERSIZED, NULL, 0, "change",
                             "is a text of %zu bytes, accepted at most %d", strlen(change),
                             DIP_CONTROL_TEXT_SIZE - 1);
    }
    strcpy(text + length, change);
    return dip_quality_parse(text, to, err);
}
