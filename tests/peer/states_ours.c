// Draws the scenes of draw states by our pipeline.
#include "tests/peer/states_ours.h"

#include <stdlib.h>
#include <string.h>

// What the shaders of one part need.
typedef struct Uniforms {
    const DipStatesData *data;
    const DipStatesPart *part;
    const float *to_clip;
    DipShadowMap map;
} Uniforms;

// The loops of the shaders read and write through `restrict` pointers, so that the compiler makes
// vectors of them.

// out[i] = row . (x, y, z, 1) of every vertex of a batch, moved by the part's place.
static void transform_row(const DipVertexBatch *batch, const Uniforms *u, const float row[4],
                          float *restrict out) {
    const float *restrict x = batch->in[0];
    const float *restrict y = batch->in[1];
    const float *restrict z = batch->in[2];
    const float a = row[0], b = row[1], c = row[2], d = row[3];
    const float px = u->part->place[0], py = u->part->place[1], pz = u->part->place[2];
    const int count = batch->count;
    for (int i = 0; i < count; i++) {
        out[i] = ((a * (x[i] + px) + b * (y[i] + py)) + c * (z[i] + pz)) + d;
    }
}

static void plain_vertex(const DipVertexBatch *batch) {
    const Uniforms *u = batch->uniforms;
    for (int c = 0; c < 4; c++) {
        transform_row(batch, u, u->to_clip + (size_t)c * 4, batch->clip[c]);
    }
}

// The varyings are the normal.
static void lit_vertex(const DipVertexBatch *batch) {
    plain_vertex(batch);
    for (int c = 0; c < 3; c++) {
        memcpy(batch->varying[c], batch->in[3 + c], (size_t)batch->count * sizeof(float));
    }
}

// The varyings are the normal and the position in the light's clip space.
static void shadowed_vertex(const DipVertexBatch *batch) {
    const Uniforms *u = batch->uniforms;
    lit_vertex(batch);
    for (int c = 0; c < 3; c++) {
        transform_row(batch, u, u->data->to_light + (size_t)c * 4, batch->varying[3 + c]);
    }
}

static void flat_fragment(DipFragmentBatch *batch) {
    const Uniforms *u = batch->uniforms;
    const float *colour = u->part->colour;
    const float red = colour[0], green = colour[1], blue = colour[2], alpha = colour[3];
    float *restrict r = batch->colour[0];
    float *restrict g = batch->colour[1];
    float *restrict b = batch->colour[2];
    float *restrict a = batch->alpha;
    const int count = batch->count;
    for (int i = 0; i < count; i++) {
        r[i] = red;
        g[i] = green;
        b[i] = blue;
        a[i] = alpha;
    }
}

static void light(DipFragmentBatch *batch, const float *restrict open) {
    const Uniforms *u = batch->uniforms;
    const float *l = u->data->light;
    const float lx = l[0], ly = l[1], lz = l[2];
    const float *restrict nx = batch->varying[0];
    const float *restrict ny = batch->varying[1];
    const float *restrict nz = batch->varying[2];
    const float red = u->part->colour[0], green = u->part->colour[1], blue = u->part->colour[2];
    float *restrict r = batch->colour[0];
    float *restrict g = batch->colour[1];
    float *restrict b = batch->colour[2];
    const int count = batch->count;
    for (int i = 0; i < count; i++) {
        float cosine = (nx[i] * lx + ny[i] * ly) + nz[i] * lz;
        cosine = cosine > 0.0f ? cosine : 0.0f;
        const float amount = 0.15f + 0.85f * cosine * open[i];
        r[i] = red * amount;
        g[i] = green * amount;
        b[i] = blue * amount;
    }
}

static void lit_fragment(DipFragmentBatch *batch) {
    float open[DIP_FRAGMENT_BATCH];
    for (int i = 0; i < DIP_FRAGMENT_BATCH; i++) {
        open[i] = 1.0f;
    }
    light(batch, open);
}

static void shadowed_fragment(DipFragmentBatch *batch) {
    const Uniforms *uniforms = batch->uniforms;
    float u[DIP_FRAGMENT_BATCH], v[DIP_FRAGMENT_BATCH], open[DIP_FRAGMENT_BATCH];
    for (int i = 0; i < batch->count; i++) {
        u[i] = 0.5f + 0.5f * batch->varying[3][i];
        v[i] = 0.5f - 0.5f * batch->varying[4][i];
    }
    batch->sample_shadow(batch, &uniforms->map, u, v, batch->varying[5], open);
    light(batch, open);
}

static DipDraw draw_of(const DipStatesOurs *ours, const Uniforms *uniforms) {
    static const DipDrawState layers[4] = {
        {.blend = DIP_BLEND_MODE_ALPHA},
        {.blend = DIP_BLEND_MODE_ADDITIVE},
        {.blend = DIP_BLEND_MODE_MULTIPLICATIVE},
        {.blend = DIP_BLEND_MODE_DOUBLE_MULTIPLICATIVE},
    };
    const DipStatesPart *part = uniforms->part;
    DipDraw draw = {.mesh = ours->meshes[part->shape],
                    .vertex_shader = lit_vertex,
                    .fragment_shader = lit_fragment,
                    .varying_count = 3,
                    .value_only_varying_count = 3,
                    .uniforms = uniforms,
                    .bounds_to_clip = NULL,
                    .cull = DIP_CULL_BACK};
    if (ours->data->kind == DIP_STATES_BLEND) {
        draw.vertex_shader = plain_vertex;
        draw.fragment_shader = flat_fragment;
        draw.varying_count = draw.value_only_varying_count = 0;
        draw.state = ours->data->opaque ? NULL : &layers[part->mode];
    } else if (ours->data->kind == DIP_STATES_SHADOW) {
        draw.vertex_shader = shadowed_vertex;
        draw.fragment_shader = shadowed_fragment;
        draw.varying_count = draw.value_only_varying_count = 6;
    }
    return draw;
}

static bool draw_map(DipStatesOurs *ours, DipError *err) {
    Uniforms uniforms[DIP_STATES_MAX_PARTS];
    DipDraw draws[DIP_STATES_MAX_PARTS];
    const int count = ours->data->part_count;
    for (int i = 0; i < count; i++) {
        uniforms[i] = (Uniforms){
            .data = ours->data, .part = &ours->data->parts[i], .to_clip = ours->data->to_light};
        draws[i] = (DipDraw){.mesh = ours->meshes[ours->data->parts[i].shape],
                             .vertex_shader = plain_vertex,
                             .uniforms = &uniforms[i],
                             .cull = DIP_CULL_FRONT};
    }
    const DipPass pass = {.draws = draws,
                          .draw_count = count,
                          .sample_count = 1,
                          .target = {.width = DIP_STATES_MAP, .height = DIP_STATES_MAP},
                          .attachments = {.depth = ours->map, .stencil_store = DIP_STORE_DISCARD}};
    DipPipelineCounters counters = {0};
    DipStageTimes times = {0};
    return dip_pipeline_draw(ours->map_pipeline, &pass, &counters, &times, err);
}

bool dip_states_ours_draw(DipStatesOurs *ours, DipError *err) {
    Uniforms uniforms[DIP_STATES_MAX_PARTS];
    DipDraw draws[DIP_STATES_MAX_PARTS];
    const int count = ours->data->part_count;
    if (ours->map && !draw_map(ours, err)) {
        return false;
    }
    for (int i = 0; i < count; i++) {
        uniforms[i] = (Uniforms){.data = ours->data,
                                 .part = &ours->data->parts[i],
                                 .to_clip = ours->data->to_clip,
                                 .map = {ours->map, DIP_SHADOW_LINEAR}};
        draws[i] = draw_of(ours, &uniforms[i]);
    }
    const DipPass pass = {.draws = draws,
                          .draw_count = count,
                          .sample_count = ours->sample_count,
                          .clear_lin = {0.25f, 0.25f, 0.25f},
                          .target = {.rgba8 = ours->rgba8,
                                     .stride_bytes = 4 * (size_t)ours->width,
                                     .width = ours->width,
                                     .height = ours->height}};
    DipStageTimes times = {0};
    ours->counters = (DipPipelineCounters){0};
    return dip_pipeline_draw(ours->pipeline, &pass, &ours->counters, &times, err);
}

bool dip_states_ours_open(DipStatesOurs *ours, const DipStatesData *data, int width, int height,
                          int sample_count, int threads, DipError *err) {
    *ours = (DipStatesOurs){
        .data = data, .width = width, .height = height, .sample_count = sample_count};
    ours->rgba8 = calloc((size_t)width * (size_t)height, 4);
    ours->pool = dip_pool_create(threads, err);
    bool done = ours->rgba8 && ours->pool;
    for (int i = 0; done && i < data->shape_count; i++) {
        const DipMeshData mesh = dip_shape_data(&data->shapes[i], "part");
        ours->meshes[i] = dip_mesh_create(&mesh, err);
        done = ours->meshes[i] != NULL;
    }
    if (done) {
        ours->pipeline = dip_pipeline_create(ours->pool, dip_isa_best(), width, height, err);
        done = ours->pipeline != NULL;
    }
    if (done && data->kind == DIP_STATES_SHADOW) {
        ours->map_pipeline =
            dip_pipeline_create(ours->pool, dip_isa_best(), DIP_STATES_MAP, DIP_STATES_MAP, err);
        ours->map = dip_depth_create(DIP_STATES_MAP, DIP_STATES_MAP, 1, err);
        done = ours->map_pipeline && ours->map;
    }
    if (!done) {
        dip_states_ours_close(ours);
    }
    return done;
}

void dip_states_ours_close(DipStatesOurs *ours) {
    dip_pipeline_destroy(&ours->pipeline);
    dip_pipeline_destroy(&ours->map_pipeline);
    dip_depth_destroy(&ours->map);
    dip_mesh_destroy(&ours->meshes[0]);
    dip_mesh_destroy(&ours->meshes[1]);
    dip_pool_destroy(&ours->pool);
    free(ours->rgba8);
    ours->rgba8 = NULL;
}
