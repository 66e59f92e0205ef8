// Makes the scenes of the peer bench of draw states.
#include "tests/peer/states_scenes.h"

#include "renderer/base/trig.h"
#include "renderer/shapes/tessellate.h"
#include "renderer/catalogue/random.h"

const char *const dip_states_names[DIP_STATES_COUNT] = {"blend", "shadow", "prism"};

static bool set_camera(DipStatesData *data, double aspect, const double eye[3], DipError *err) {
    const double target[3] = {0.0, 0.0, 0.0}, up[3] = {0.0, 1.0, 0.0};
    const DipPerspective lens = {.fov_deg = 45.0, .aspect = aspect, .near_distance = 0.1};
    DipMatrix view, projection;
    if (!dip_camera_look_at(&view, eye, target, up, err) ||
        !dip_camera_perspective(&projection, &lens, err)) {
        return false;
    }
    const DipMatrix to_clip = dip_matrix_multiply(&projection, &view);
    dip_matrix_floats(&to_clip, data->to_clip);
    return true;
}

static bool make_blend(DipStatesData *data, double aspect, DipError *err) {
    const double eye[3] = {0.0, 0.0, 8.0};
    Random random = {8};
    data->part_count = 40;
    for (int i = 0; i < data->part_count; i++) {
        DipStatesPart *part = &data->parts[i];
        *part = (DipStatesPart){.place = {(float)random_real(&random, -2.5, 2.5),
                                          (float)random_real(&random, -2.0, 2.0), 0.02f * (float)i},
                                .mode = i % 4};
        for (int c = 0; c < 4; c++) {
            part->colour[c] = (float)random_real(&random, 0.2, 0.8);
        }
    }
    data->shape_count = 1;
    return set_camera(data, aspect, eye, err) && dip_shape_quad(&data->shapes[0], 3.6f, 3.0f, err);
}

static bool make_shadow(DipStatesData *data, double aspect, DipError *err) {
    const double eye[3] = {5.0, 5.0, 8.0}, at[3] = {6.0, 10.0, 3.0}, target[3] = {0.0, 0.0, 0.0};
    const double up[3] = {0.0, 1.0, 0.0};
    const DipOrthographic box = {-6.0, 6.0, -6.0, 6.0, .near_distance = 1.0, .far_distance = 25.0};
    Random random = {9};
    data->part_count = 33;
    data->parts[0] = (DipStatesPart){.shape = 1, .colour = {0.5f, 0.5f, 0.5f, 1.0f}};
    for (int i = 1; i < data->part_count; i++) {
        DipStatesPart *part = &data->parts[i];
        *part = (DipStatesPart){.place = {(float)random_real(&random, -4.0, 4.0),
                                          (float)random_real(&random, 0.5, 2.5),
                                          (float)random_real(&random, -4.0, 4.0)}};
        for (int c = 0; c < 4; c++) {
            part->colour[c] = (float)random_real(&random, 0.2, 0.9);
        }
    }
    data->shape_count = 2;
    DipMatrix view, projection;
    const bool made = set_camera(data, aspect, eye, err) &&
                      dip_camera_look_at(&view, at, target, up, err) &&
                      dip_camera_orthographic(&projection, &box, err) &&
                      dip_shape_sphere(&data->shapes[0], 0.45f, 32, 16, err) &&
                      dip_shape_plane(&data->shapes[1], 10.0f, 10.0f, 1, 1, err);
    if (made) {
        const DipMatrix to_light = dip_matrix_multiply(&projection, &view);
        dip_matrix_floats(&to_light, data->to_light);
    }
    return made;
}

// Twists a point of the prism's side about the y axis, by half a radian per unit of height.
static void twist(const DipDomainBatch *batch) {
    dip_domain_linear(batch);
    for (int i = 0; i < batch->count; i++) {
        float *v = batch->out + (size_t)i * (size_t)batch->out_attribute_count;
        const double angle = 0.5 * (double)v[1];
        const float s = (float)dip_sin(angle);
        const float c = (float)dip_cos(angle);
        for (int k = 0; k < 6; k += 3) { // the position and the normal
            const float x = v[k];
            const float z = v[k + 2];
            v[k] = x * c - z * s;
            v[k + 2] = z * c + x * s;
        }
    }
}

static bool make_prism(DipStatesData *data, double aspect, DipError *err) {
    const double eye[3] = {0.0, 2.0, 5.0};
    const DipTessellationFactors factors = {{64.0f, 64.0f, 64.0f, 64.0f}, {64.0f, 64.0f}};
    DipShape prism;
    if (!set_camera(data, aspect, eye, err) ||
        !dip_shape_prism(&prism, 1.2f, 3.0f, 8, false, err)) {
        return false;
    }
    const DipTessellationDef def = {
        .domain = DIP_DOMAIN_TRIANGLE,
        .partitioning = DIP_PARTITIONING_FRACTIONAL_ODD,
        .attributes = prism.attributes,
        .attribute_count = prism.attribute_count,
        .vertex_count = prism.vertex_count,
        .indices = prism.indices,
        .index_count = prism.index_count,
        .factors = &factors,
        .same_factors = true,
        .function = twist,
        .out_attribute_count = DIP_SHAPE_ATTRIBUTES,
    };
    const bool made = dip_tessellate(&data->shapes[0], &def, err);
    dip_shape_free(&prism);
    data->shape_count = 1;
    data->part_count = 1;
    data->parts[0] = (DipStatesPart){.colour = {0.8f, 0.5f, 0.2f, 1.0f}};
    return made;
}

bool dip_states_make(DipStatesScene kind, double aspect, DipStatesData *data, DipError *err) {
    *data = (DipStatesData){.kind = kind, .light = {0.498f, 0.83f, 0.249f}};
    switch (kind) {
    case DIP_STATES_BLEND:
        return make_blend(data, aspect, err);
    case DIP_STATES_SHADOW:
        return make_shadow(data, aspect, err);
    default:
        return make_prism(data, aspect, err);
    }
}

void dip_states_free(DipStatesData *data) {
    for (int i = 0; i < data->shape_count; i++) {
        dip_shape_free(&data->shapes[i]);
    }
}
