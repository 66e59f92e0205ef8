// The options of `diptych preview`.
#include "app/preview/options.h"

#include "renderer/base/assert.h"

#define FIELD(name) offsetof(DipPreviewOptions, name)

static const DipOptionRow rows[] = {
    {.name = "--cost",
     .argument = "FILE",
     .text = "Read the cost.json that `diptych cost` wrote for this scene. The window then shows "
             "what each setting costs and advises the best settings for a time budget.",
     .kind = DIP_OPTION_TEXT,
     .field = FIELD(cost_report)},
};

static const DipOptionTable table = {"Drawing", rows, DIP_ARRAY_COUNT(rows)};

static const DipOptionPart parts[] = {
    {&dip_scene_option_table, FIELD(session)},
    {&dip_path_option_table, FIELD(session)},
    {&dip_category_option_table, FIELD(session)},
    {&dip_pane_option_table, FIELD(session)},
    {&dip_size_option_table, FIELD(session)},
    {&dip_threads_option_table, FIELD(session)},
    {&table, 0},
    {&dip_program_option_table, FIELD(program)},
};
const DipOptionParts dip_preview_option_parts = {parts, DIP_ARRAY_COUNT(parts)};

bool dip_preview_options_check(const void *options, DipError *err) {
    return dip_session_options_check(&((const DipPreviewOptions *)options)->session, err);
}
