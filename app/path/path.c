// `diptych path info` and `diptych path convert`.
#include "app/commands.h"

#include "campaths/campath.h"

#include <stdio.h>
#include <string.h>

bool dip_path_info_run(const DipOptions *options, DipError *err) {
    DipCamPath *path;
    if (!dip_campath_load(options->operands[0], &path, err)) {
        return false;
    }
    const DipCamPathInfo info = dip_campath_info(path);
    printf("file       %s\n", options->operands[0]);
    printf("keys       %zu, %.9g s apart\n", info.key_count, 1e-9 * (double)info.period_ns);
    printf("duration   %.9g s, then again from the beginning\n", 1e-9 * (double)info.duration_ns);
    printf("length     %.6g m\n", info.length_m);
    printf("box        %.6g %.6g %.6g to %.6g %.6g %.6g m\n", info.min_world[0], info.min_world[1],
           info.min_world[2], info.max_world[0], info.max_world[1], info.max_world[2]);
    printf("at most    %.6g m/s, %.6g degrees/s\n", info.max_speed_m_per_s,
           info.max_turn_deg_per_s);
    dip_campath_destroy(&path);
    return true;
}

static bool ends_with(const char *text, const char *end) {
    const size_t length = strlen(text);
    return length >= strlen(end) && strcmp(text + length - strlen(end), end) == 0;
}

bool dip_path_convert_run(const DipOptions *options, DipError *err) {
    const char *to = options->operands[1];
    const bool text = ends_with(to, ".pth");
    if (!text && !ends_with(to, ".bth")) {
        return dip_error_set(err, DIP_ERROR_UNKNOWN, NULL, 0, "path convert",
                             "'%s' says no format, accepted a name that ends in .pth or .bth", to);
    }
    DipCamPath *path;
    if (!dip_campath_load(options->operands[0], &path, err)) {
        return false;
    }
    const bool saved =
        text ? dip_campath_save_pth(path, to, err) : dip_campath_save_bth(path, to, err);
    dip_campath_destroy(&path);
    return saved;
}
