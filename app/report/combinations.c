// Lists combinations of settings.
#include "app/report/combinations.h"

typedef struct List {
    unsigned settings;
    DipQuality *items;
    int room;
    int count;
} List;

static void add_from(List *list, DipQuality quality, int setting) {
    while (setting < DIP_SETTING_COUNT && !(list->settings >> setting & 1)) {
        setting++;
    }
    if (setting < DIP_SETTING_COUNT) {
        for (int step = 0; step < dip_setting_info((DipSetting)setting)->step_count; step++) {
            quality.step[setting] = (uint8_t)step;
            add_from(list, quality, setting + 1);
        }
        return;
    }
    const DipQuality effective = dip_quality_effective(&quality);
    if (dip_quality_check(&quality, NULL) && dip_quality_equal(&quality, &effective)) {
        if (list->count < list->room) {
            list->items[list->count] = quality;
        }
        list->count++;
    }
}

int dip_cost_list_combinations(const DipQuality *baseline, unsigned settings, DipQuality *list,
                               int room) {
    List all = {.settings = settings, .items = list, .room = room};
    add_from(&all, *baseline, 0);
    return all.count;
}

unsigned dip_cost_sampling_settings(void) {
    return 1u << DIP_SETTING_AA | 1u << DIP_SETTING_TAA | 1u << DIP_SETTING_AAA |
           1u << DIP_SETTING_ASD;
}

DipQuality dip_cost_take_settings(const DipQuality *from, const DipQuality *with, unsigned mask) {
    DipQuality taken = *from;
    for (int s = 0; s < DIP_SETTING_COUNT; s++) {
        if (mask >> s & 1) {
            taken.step[s] = with->step[s];
        }
    }
    return taken;
}
