// Makes adversarial scenes: the view, the settings and the objects.
#include "tests/stability/search/scene_from_choices.h"

#include "renderer/base/trig.h"
#include "tests/stability/search/maker.h"

#include <math.h>
#include <string.h>

// --- view and settings ---------------------------------------------------------------------------

static void choose_size(SearchMaker *maker) {
    static const int sizes[][2] = {{16, 12}, {64, 48}, {64, 48}, {64, 48}, {61, 47},
                                   {33, 17}, {1, 48},  {64, 1},  {5, 3},   {1, 1}};
    const int *size = sizes[choices_draw(maker->choices, sizeof sizes / sizeof *sizes)];
    maker->made->width = size[0];
    maker->made->height = size[1];
}

// Draws a step of a setting. The number 0 means the default step.
static void choose_step(SearchMaker *maker, DipSetting setting) {
    const DipSettingInfo *info = dip_setting_info(setting);
    const int step =
        info->default_step + (int)choices_draw(maker->choices, (uint64_t)info->step_count);
    maker->made->quality.step[setting] = (uint8_t)(step % info->step_count);
}

static void choose_settings(SearchMaker *maker) {
    DipQuality *quality = &maker->made->quality;
    *quality = dip_quality_default();
    for (int s = 0; s < DIP_SETTING_COUNT; s++) {
        // Filters of the finished picture, which also enlarge that of a scale below 1, are not part
        // of what the judges compare.
        if (s == DIP_SETTING_UPSCALE || s == DIP_SETTING_POST || s == DIP_SETTING_SHARPEN ||
            s == DIP_SETTING_SHADOWS) {
            continue;
        }
        // Nor is a history, which blends frames.
        if (s == DIP_SETTING_TAA) {
            quality->step[s] = (uint8_t)choices_draw(maker->choices, DIP_TAA_HISTORY);
            continue;
        }
        if (s == DIP_SETTING_SCALE) {
            quality->step[s] = (uint8_t)(DIP_SCALE_1 + choices_draw(maker->choices, 4));
            continue;
        }
        if (s != DIP_SETTING_MIPDEBUG || choices_rarely(maker->choices, 3)) {
            choose_step(maker, (DipSetting)s);
        }
    }
    if (!dip_quality_check(quality, NULL)) {
        quality->step[DIP_SETTING_ASD] = 0;
    }
    dip_quality_format(quality, maker->made->settings, sizeof maker->made->settings);
}

static void choose_orientation(SearchMaker *maker, double q[4]) {
    double turn[3] = {0.0, 0.0, 0.0}; // half the angles of pitch, yaw and roll
    if (choices_rarely(maker->choices, 2)) {
        for (int i = 0; i < 3; i++) {
            turn[i] = choices_real(maker->choices, i == 0 ? 0.5 : DIP_PI / 2.0);
        }
    }
    const double pitch[2] = {dip_sin(turn[0]), dip_cos(turn[0])};
    const double yaw[2] = {dip_sin(turn[1]), dip_cos(turn[1])};
    const double roll[2] = {dip_sin(turn[2]), dip_cos(turn[2])};
    // The product yaw * pitch * roll.
    const double x = yaw[1] * pitch[0], y = yaw[0] * pitch[1], z = -yaw[0] * pitch[0],
                 w = yaw[1] * pitch[1];
    q[0] = x * roll[1] + y * roll[0];
    q[1] = y * roll[1] - x * roll[0];
    q[2] = z * roll[1] + w * roll[0];
    q[3] = w * roll[1] - z * roll[0];
}

static void find_rotation(SearchMaker *maker) {
    const double *q = maker->made->scene.pose.orientation;
    const double x = q[0], y = q[1], z = q[2], w = q[3];
    const double rows[3][3] = {{1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)},
                               {2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)},
                               {2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)}};
    memcpy(maker->rotation, rows, sizeof rows);
}

static void choose_position(SearchMaker *maker, double position[3]) {
    static const double far[] = {0.0, 512.0, 1000.0, 65536.0, 131072.5, 1e6, 1e7};
    const int kind = (int)choices_draw(maker->choices, 6);
    for (int i = 0; i < 3 && kind >= 2; i++) {
        position[i] = choices_real(maker->choices, 8.0);
        if (kind == 5) {
            const double offset = far[choices_draw(maker->choices, 7)];
            position[i] += choices_draw(maker->choices, 2) ? -offset : offset;
        }
    }
}

static void choose_view(SearchMaker *maker) {
    static const double fields[] = {60.0, 60.0, 90.0, 30.0, 10.0, 120.0, 1.0, 160.0};
    static const float nears[] = {0.1f, 0.125f, 1.0f, 0x1p-10f, 1e-3f, 1e-6f, 4.0f, 1e-12f};
    static const int64_t times[] = {
        0, INT64_C(1000000000), INT64_C(123456789012), INT64_C(-5000000001), INT64_MAX, INT64_MIN};
    SearchScene *made = maker->made;
    Choices *choices = maker->choices;
    DipPose *pose = &made->scene.pose;
    pose->fov_y_deg = fields[choices_draw(choices, 8)];
    made->scene.def.near_m = nears[choices_draw(choices, 8)];
    choose_orientation(maker, pose->orientation);
    find_rotation(maker);
    choose_position(maker, pose->position_world);
    made->time_ns = times[choices_draw(choices, 6)];
    made->frame_index = choices_draw(choices, 3);
    maker->half_height = dip_tan(pose->fov_y_deg * DIP_PI / 360.0);
    maker->half_width = maker->half_height * made->width / made->height;
}

// --- water ---------------------------------------------------------------------------------------

// Lets water reflect, at the height of its first vertex.
static void choose_reflection(SearchMaker *maker) {
    static const int sizes[][2] = {{0, 0}, {64, 48}, {32, 24}, {64, 48}, {33, 7}, {1, 1}};
    DipTestScene *scene = &maker->made->scene;
    for (int i = 0; i < scene->def.object_count; i++) {
        const DipMeshDef *mesh = &scene->meshes[scene->objects[i].mesh];
        if (scene->materials[mesh->material].surface == DIP_SURFACE_WATER) {
            const int *size = sizes[choices_draw(maker->choices, 6)];
            const float *m = scene->objects[i].transform + 4;
            const float *p = mesh->positions;
            const double level = (double)m[0] * (double)p[0] + (double)m[1] * (double)p[1] +
                                 (double)m[2] * (double)p[2] + (double)m[3];
            scene->reflection = (DipReflectionDef){.width = size[0],
                                                   .height = size[1],
                                                   .level_m = level,
                                                   .schlick = choices_draw(maker->choices, 2)};
            return;
        }
    }
}

// --- the scene -----------------------------------------------------------------------------------

static void add_object(SearchMaker *maker) {
    DipTestScene *scene = &maker->made->scene;
    if (scene->def.object_count > 0 && choices_rarely(maker->choices, 6)) {
        search_add_instance(maker);
        return;
    }
    search_make_shape(maker);
    const bool same = scene->def.material_count > 0 && choices_rarely(maker->choices, 4);
    const int material = same ? scene->def.material_count - 1 : search_make_material(maker);
    search_add_mesh(maker, material);
}

void search_scene_make(SearchScene *made, Choices *choices) {
    enum { MOST_OBJECTS = 6 };
    memset(made, 0, sizeof *made);
    dip_test_scene_begin(&made->scene);
    made->scene.def.sky = dip_sky_default();
    SearchMaker maker = {.choices = choices, .made = made};
    choose_size(&maker);
    choose_settings(&maker);
    choose_view(&maker);
    bool more = true;
    while (more) {
        const int part = choices_begin_part(choices, -1);
        add_object(&maker);
        more = made->scene.def.object_count < MOST_OBJECTS && choices_draw(choices, 4) != 0;
        choices_end_part(choices, part);
    }
    choose_reflection(&maker);
    search_finish_materials(&maker);
}

StabilityShot search_scene_shot(const SearchScene *made) {
    return (StabilityShot){
        .def = &made->scene.def,
        .pose = &made->scene.pose,
        .reflection = made->scene.reflection.width ? &made->scene.reflection : NULL,
        .settings = made->settings,
        .width = made->width,
        .height = made->height,
        .time_ns = made->time_ns,
        .frame_index = made->frame_index,
        .share_differences = true,
        .shift = {made->shift[0], made->shift[1], made->shift[2]},
        .in_floats = made->in_floats,
    };
}
