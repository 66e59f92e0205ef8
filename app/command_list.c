// Lists Diptych's commands. To add a command, add its include and its entry here.
#include "app/command_list.h"

#include "app/bench/options.h"
#include "app/compare/compare.h"
#include "app/cost/command.h"
#include "app/dump/options.h"
#include "app/import/import.h"
#include "app/path/path.h"
#include "app/preview/command.h"
#include "app/verify/verify.h"
#include "renderer/base/assert.h"

static const DipCommand *const commands[] = {
    &dip_preview_command,      &dip_dump_command,         &dip_bench_command,
    &dip_cost_command,         &dip_cost_merge_command,   &dip_cost_diff_command,
    &dip_cost_advise_command,  &dip_cost_predict_command, &dip_path_info_command,
    &dip_path_convert_command, &dip_compare_command,      &dip_verify_command,
};

static const DipCommand *const hidden[] = {&dip_import_command};

static const DipMovedCommand moved[] = {
    {"cost axes", "`diptych bench --scale 0.5,1 --threads 1,2`, with a list for all that varies"}};

const DipCommandList dip_command_list = {commands, DIP_ARRAY_COUNT(commands),
                                         hidden,   DIP_ARRAY_COUNT(hidden),
                                         moved,    DIP_ARRAY_COUNT(moved)};
