// The pictures of docs/pipeline.md, from the first triangle to a mirror. The document quotes this
// file.
//
// Usage: guide FOLDER (writes guide_1.ppm to guide_8.ppm into the folder)
#include "renderer/pipeline/pipeline.h"
#include "renderer/shapes/camera.h"
#include "renderer/shapes/shapes.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { WIDTH = 320, HEIGHT = 240, MAP = 512, SPARKS = 60 };

static uint8_t picture[HEIGHT][WIDTH][4];

// Ends the program if something failed.
static void require(bool done, const DipError *err) {
    if (!done) {
        fprintf(stderr, "%s: %s\n", err->key, err->message);
        exit(1);
    }
}

// --- 1. a triangle -------------------------------------------------------------------------------

// Attributes 0..2 are clip coordinates, attributes 3..5 a colour, which becomes varyings 0..2.
static void flat_vertex(const DipVertexBatch *batch) {
    for (int i = 0; i < batch->count; i++) {
        batch->clip[0][i] = batch->in[0][i];
        batch->clip[1][i] = batch->in[1][i];
        batch->clip[2][i] = batch->in[2][i];
        batch->clip[3][i] = 1.0f;
        for (int c = 0; c < 3; c++) {
            batch->varying[c][i] = batch->in[3 + c][i];
        }
    }
}

static void show_colour(DipFragmentBatch *batch) {
    for (int c = 0; c < 3; c++) {
        for (int i = 0; i < batch->count; i++) {
            batch->colour[c][i] = batch->varying[c][i];
        }
    }
}

static void draw_triangle(DipPipeline *pipeline) {
    static const float vertices[3][6] = {{-0.8f, -0.7f, 0.5f, 1.0f, 0.0f, 0.0f},
                                         {0.8f, -0.7f, 0.5f, 0.0f, 1.0f, 0.0f},
                                         {0.0f, 0.8f, 0.5f, 0.0f, 0.0f, 1.0f}};
    static const uint32_t indices[3] = {0, 1, 2};
    DipError err = {0};
    DipMesh *mesh =
        dip_mesh_create(&(DipMeshData){"triangle", &vertices[0][0], 6, 3, indices, 3}, &err);
    require(mesh != NULL, &err);
    const DipDraw draw = {.mesh = mesh,
                          .vertex_shader = flat_vertex,
                          .fragment_shader = show_colour,
                          .varying_count = 3};
    const DipPass pass = {
        .draws = &draw,
        .draw_count = 1,
        .sample_count = 4,
        .clear_lin = {0.02f, 0.02f, 0.03f},
        .target = {.rgba8 = &picture[0][0][0],
                   .stride_bytes = WIDTH * 4,
                   .width = WIDTH,
                   .height = HEIGHT},
    };
    DipPipelineCounters counters = {0};
    DipStageTimes times = {0};
    require(dip_pipeline_draw(pipeline, &pass, &counters, &times, &err), &err);
    dip_mesh_destroy(&mesh);
}

// --- 2. a lit scene ------------------------------------------------------------------------------

// What the shaders of the lit scene need.
typedef struct Lit {
    DipMatrix to_world; // moves the mesh, and does not turn it
    float to_clip[16];
    float colour[3];
    float alpha;
    float to_light[3]; // unit vector
    // Step 6: takes positions to the light's map, and the depths that the light sees.
    float to_map[16];
    DipShadowMap shadows;
} Lit;

// Varyings 0..2 are the normal.
static void lit_vertex(const DipVertexBatch *batch) {
    const Lit *lit = batch->uniforms;
    dip_vertices_transform(batch, lit->to_clip, 4, batch->clip);
    dip_vertices_copy(batch, DIP_SHAPE_NORMAL, 0, 3);
}

// Returns the light that falls on fragment i, without shadows: 0..1.
static float diffuse(const DipFragmentBatch *batch, const Lit *lit, int i) {
    const float n[3] = {batch->varying[0][i], batch->varying[1][i], batch->varying[2][i]};
    const float length = sqrtf((n[0] * n[0] + n[1] * n[1]) + n[2] * n[2]);
    const float *l = lit->to_light;
    const float cosine = ((n[0] * l[0] + n[1] * l[1]) + n[2] * l[2]) / length;
    return cosine > 0.0f ? cosine : 0.0f;
}

static void lit_fragment(DipFragmentBatch *batch) {
    const Lit *lit = batch->uniforms;
    for (int i = 0; i < batch->count; i++) {
        const float light = 0.12f + 0.88f * diffuse(batch, lit, i);
        for (int c = 0; c < 3; c++) {
            batch->colour[c][i] = lit->colour[c] * light;
        }
        batch->alpha[i] = lit->alpha;
    }
}

typedef struct World {
    DipPipeline *pipeline;
    DipPipeline *map_pipeline; // of the size of the shadow map
    DipMesh *ball;
    DipMesh *spark;
    DipMesh *ground;
    DipMesh *mirror;
    DipMatrix to_clip;
    DipMatrix to_light_clip;
} World;

static DipMesh *mesh_of(DipShape *shape, const char *name) {
    DipError err = {0};
    const DipMeshData data = dip_shape_data(shape, name);
    DipMesh *mesh = dip_mesh_create(&data, &err);
    require(mesh != NULL, &err);
    dip_shape_free(shape);
    return mesh;
}

static void make_camera(World *world) {
    const double eye[3] = {3.0, 2.6, 5.0}, target[3] = {0.0, 0.6, 0.0}, up[3] = {0.0, 1.0, 0.0};
    const DipPerspective lens = {
        .fov_deg = 40.0, .aspect = (double)WIDTH / HEIGHT, .near_distance = 0.1};
    DipMatrix view, projection;
    DipError err = {0};
    require(dip_camera_look_at(&view, eye, target, up, &err), &err);
    require(dip_camera_perspective(&projection, &lens, &err), &err);
    world->to_clip = dip_matrix_multiply(&projection, &view);
}

// Writes the matrix that takes the mesh to where `to_clip` takes the world.
static void set_view(float out[16], const Lit *lit, const DipMatrix *to_clip) {
    const DipMatrix product = dip_matrix_multiply(to_clip, &lit->to_world);
    dip_matrix_floats(&product, out);
}

static Lit lit_at(const World *world, double x, double y, double z, const float colour[3]) {
    Lit lit = {.to_world = dip_matrix_translation(x, y, z),
               .alpha = 1.0f,
               .to_light = {0.48f, 0.8f, 0.36f}};
    for (int c = 0; c < 3; c++) {
        lit.colour[c] = colour[c];
    }
    set_view(lit.to_clip, &lit, &world->to_clip);
    return lit;
}

static DipDraw lit_draw(const DipMesh *mesh, const Lit *lit) {
    return (DipDraw){.mesh = mesh,
                     .vertex_shader = lit_vertex,
                     .fragment_shader = lit_fragment,
                     .varying_count = 3,
                     .value_only_varying_count = 3,
                     .uniforms = lit,
                     .cull = DIP_CULL_BACK};
}

static const float red[3] = {0.75f, 0.12f, 0.08f};
static const float stone[3] = {0.45f, 0.47f, 0.5f};

static void draw_world(World *world, const DipDraw *draws, int count) {
    const DipPass pass = {
        .draws = draws,
        .draw_count = count,
        .sample_count = 4,
        .clear_lin = {0.25f, 0.42f, 0.65f},
        .target = {.rgba8 = &picture[0][0][0],
                   .stride_bytes = WIDTH * 4,
                   .width = WIDTH,
                   .height = HEIGHT},
    };
    DipPipelineCounters counters = {0};
    DipStageTimes times = {0};
    DipError err = {0};
    require(dip_pipeline_draw(world->pipeline, &pass, &counters, &times, &err), &err);
}

static void draw_lit(World *world) {
    const Lit ground = lit_at(world, 0.0, 0.0, 0.0, stone);
    const Lit ball = lit_at(world, 0.0, 1.0, 0.0, red);
    const DipDraw draws[2] = {lit_draw(world->ground, &ground), lit_draw(world->ball, &ball)};
    draw_world(world, draws, 2);
}

// --- 3. blending ---------------------------------------------------------------------------------

static void draw_glass(World *world) {
    static const DipDrawState glass = {.blend = DIP_BLEND_MODE_ALPHA, .keep_depth = true};
    static const float green[3] = {0.1f, 0.6f, 0.3f};
    const Lit ground = lit_at(world, 0.0, 0.0, 0.0, stone);
    const Lit ball = lit_at(world, 0.0, 1.0, 0.0, red);
    Lit bubble = lit_at(world, 0.9, 0.9, 1.2, green);
    bubble.alpha = 0.4f;
    DipDraw draws[3] = {lit_draw(world->ground, &ground), lit_draw(world->ball, &ball),
                        lit_draw(world->ball, &bubble)};
    draws[2].state = &glass;
    draw_world(world, draws, 3);
}

// --- 4. stencil ----------------------------------------------------------------------------------

// Moves the positions outwards along the normals.
static void grown_vertex(const DipVertexBatch *batch) {
    const Lit *lit = batch->uniforms;
    for (int i = 0; i < batch->count; i++) {
        float p[3];
        for (int c = 0; c < 3; c++) {
            p[c] =
                batch->in[DIP_SHAPE_POSITION + c][i] + 0.06f * batch->in[DIP_SHAPE_NORMAL + c][i];
        }
        for (int r = 0; r < 4; r++) {
            const float *m = lit->to_clip + 4 * r;
            batch->clip[r][i] = m[0] * p[0] + m[1] * p[1] + m[2] * p[2] + m[3];
        }
    }
}

static void one_colour(DipFragmentBatch *batch) {
    const Lit *lit = batch->uniforms;
    for (int c = 0; c < 3; c++) {
        for (int i = 0; i < batch->count; i++) {
            batch->colour[c][i] = lit->colour[c];
        }
    }
}

static void draw_outline(World *world) {
    static const DipDrawState marks = {
        .stencil = {.enabled = true,
                    .reference = 1,
                    .read_mask = 255,
                    .write_mask = 255,
                    .front = {.function = DIP_COMPARE_ALWAYS, .passed = DIP_STENCIL_REPLACE},
                    .back = {.function = DIP_COMPARE_ALWAYS, .passed = DIP_STENCIL_REPLACE}}};
    static const DipDrawState outside = {.depth_test = DIP_DEPTH_ALWAYS,
                                         .stencil = {.enabled = true,
                                                     .reference = 1,
                                                     .read_mask = 255,
                                                     .front = {.function = DIP_COMPARE_NOT_EQUAL},
                                                     .back = {.function = DIP_COMPARE_NOT_EQUAL}}};
    static const float gold[3] = {1.0f, 0.7f, 0.1f};
    const Lit ground = lit_at(world, 0.0, 0.0, 0.0, stone);
    const Lit ball = lit_at(world, 0.0, 1.0, 0.0, red);
    const Lit line = lit_at(world, 0.0, 1.0, 0.0, gold);
    DipDraw draws[3] = {lit_draw(world->ground, &ground), lit_draw(world->ball, &ball),
                        lit_draw(world->ball, &line)};
    draws[1].state = &marks;
    draws[2].state = &outside;
    draws[2].vertex_shader = grown_vertex;
    draws[2].fragment_shader = one_colour;
    draws[2].varying_count = draws[2].value_only_varying_count = 0;
    draw_world(world, draws, 3);
}

// --- 5. wireframe --------------------------------------------------------------------------------

static void draw_wires(World *world) {
    static const DipDrawState wires = {
        .fill = DIP_FILL_WIREFRAME, .line_width = 1.5f, .depth_test = DIP_DEPTH_NEARER_OR_EQUAL};
    static const float white[3] = {1.0f, 1.0f, 1.0f};
    const Lit ground = lit_at(world, 0.0, 0.0, 0.0, stone);
    const Lit ball = lit_at(world, 0.0, 1.0, 0.0, red);
    const Lit lines = lit_at(world, 0.0, 1.0, 0.0, white);
    DipDraw draws[3] = {lit_draw(world->ground, &ground), lit_draw(world->ball, &ball),
                        lit_draw(world->ball, &lines)};
    draws[2].state = &wires;
    draw_world(world, draws, 3);
}

// --- 6. a shadow map -----------------------------------------------------------------------------

static void make_light(World *world) {
    const double at[3] = {4.8, 8.0, 3.6}, target[3] = {0.0, 0.0, 0.0}, up[3] = {0.0, 1.0, 0.0};
    const DipOrthographic box = {-4.0, 4.0, -4.0, 4.0, .near_distance = 1.0, .far_distance = 20.0};
    DipMatrix view, projection;
    DipError err = {0};
    require(dip_camera_look_at(&view, at, target, up, &err), &err);
    require(dip_camera_orthographic(&projection, &box, &err), &err);
    world->to_light_clip = dip_matrix_multiply(&projection, &view);
}

// Varyings 3..5 are u, v and z in the light's map.
static void shadowed_vertex(const DipVertexBatch *batch) {
    const Lit *lit = batch->uniforms;
    lit_vertex(batch);
    dip_vertices_transform(batch, lit->to_map, 3, batch->varying + 3);
}

static void shadowed_fragment(DipFragmentBatch *batch) {
    const Lit *lit = batch->uniforms;
    float open[DIP_FRAGMENT_BATCH];
    batch->sample_shadow(batch, &lit->shadows, batch->varying[3], batch->varying[4],
                         batch->varying[5], open);
    for (int i = 0; i < batch->count; i++) {
        const float light = 0.12f + 0.88f * diffuse(batch, lit, i) * open[i];
        for (int c = 0; c < 3; c++) {
            batch->colour[c][i] = lit->colour[c] * light;
        }
    }
}

// Draws what the light sees: depths alone.
static void draw_map(World *world, DipDepth *depth) {
    static const DipDrawState away = {.depth_bias = {.slope = -2.0f, .constant = -0x1p-20f}};
    Lit ball = lit_at(world, 0.0, 1.0, 0.0, red);
    set_view(ball.to_clip, &ball, &world->to_light_clip);
    DipDraw draw = lit_draw(world->ball, &ball);
    draw.fragment_shader = NULL;
    draw.state = &away;
    const DipPass pass = {.draws = &draw,
                          .draw_count = 1,
                          .sample_count = 1,
                          .target = {.width = MAP, .height = MAP},
                          .attachments = {.depth = depth}};
    DipPipelineCounters counters = {0};
    DipStageTimes times = {0};
    DipError err = {0};
    require(dip_pipeline_draw(world->map_pipeline, &pass, &counters, &times, &err), &err);
}

static void draw_shadow(World *world) {
    DipError err = {0};
    DipDepth *depth = dip_depth_create(MAP, MAP, 1, &err);
    require(depth != NULL, &err);
    draw_map(world, depth);
    const DipMatrix half = dip_matrix_to_map();
    const DipMatrix to_map = dip_matrix_multiply(&half, &world->to_light_clip);
    Lit lit[2] = {lit_at(world, 0.0, 0.0, 0.0, stone), lit_at(world, 0.0, 1.0, 0.0, red)};
    DipDraw draws[2] = {lit_draw(world->ground, &lit[0]), lit_draw(world->ball, &lit[1])};
    for (int i = 0; i < 2; i++) {
        set_view(lit[i].to_map, &lit[i], &to_map);
        lit[i].shadows = (DipShadowMap){depth, DIP_SHADOW_LINEAR};
        draws[i].vertex_shader = shadowed_vertex;
        draws[i].fragment_shader = shadowed_fragment;
        draws[i].varying_count = draws[i].value_only_varying_count = 6;
    }
    draw_world(world, draws, 2);
    dip_depth_destroy(&depth);
}

// --- 7. particles over a kept picture ------------------------------------------------------------

// What outlives the passes of a picture with particles.
typedef struct Kept {
    DipSamples *samples;
    DipDepth *depth;
} Kept;

static Kept make_kept(void) {
    DipError err = {0};
    const Kept kept = {.samples = dip_samples_create(WIDTH, HEIGHT, 4, DIP_FORMAT_SRGB8, &err),
                       .depth = dip_depth_create(WIDTH, HEIGHT, 4, &err)};
    require(kept.samples && kept.depth, &err);
    return kept;
}

// Draws the ground and the ball, and keeps their colours and depths in every sample.
static void draw_still(World *world, const Kept *kept) {
    const Lit ground = lit_at(world, 0.0, 0.0, 0.0, stone);
    const Lit ball = lit_at(world, 0.0, 1.0, 0.0, red);
    const DipDraw draws[2] = {lit_draw(world->ground, &ground), lit_draw(world->ball, &ball)};
    const DipPass still = {
        .draws = draws,
        .draw_count = 2,
        .sample_count = 4,
        .clear_lin = {0.25f, 0.42f, 0.65f},
        .target = {.width = WIDTH, .height = HEIGHT},
        .attachments = {.samples = kept->samples, .keep_target = true, .depth = kept->depth},
    };
    DipError err = {0};
    require(dip_pipeline_draw(world->pipeline, &still, NULL, NULL, &err), &err);
}

// Draws particles over the samples that are kept, and shows the result in the picture.
static void draw_over(World *world, const Kept *kept, const DipDraw *particles, int count) {
    const DipPass over = {
        .draws = particles,
        .draw_count = count,
        .sample_count = 4,
        .target = {.rgba8 = &picture[0][0][0],
                   .stride_bytes = WIDTH * 4,
                   .width = WIDTH,
                   .height = HEIGHT},
        .attachments = {.samples = kept->samples,
                        .colour_load = DIP_LOAD_KEEP,
                        .colour_store = DIP_STORE_REVERT,
                        .depth = kept->depth,
                        .depth_load = DIP_LOAD_KEEP,
                        .depth_store = DIP_STORE_REVERT},
    };
    DipError err = {0};
    require(dip_pipeline_draw(world->pipeline, &over, NULL, NULL, &err), &err);
}

// Places glowing sparks on a spiral around the ball. Their positions turn by a fixed angle, whose
// cosine is 0.8 and whose sine is 0.6.
static void draw_sparks(World *world) {
    static const DipDrawState glow = {.blend = DIP_BLEND_MODE_ADDITIVE, .keep_depth = true};
    static const float gold[3] = {1.0f, 0.55f, 0.15f};
    Lit sparks[SPARKS];
    DipDraw draws[SPARKS];
    float x = 1.25f, z = 0.0f;
    for (int i = 0; i < SPARKS; i++) {
        sparks[i] = lit_at(world, x, 0.2 + 0.03 * i, z, gold);
        draws[i] = lit_draw(world->spark, &sparks[i]);
        draws[i].fragment_shader = one_colour;
        draws[i].state = &glow;
        const float turned = 0.8f * x - 0.6f * z;
        z = 0.6f * x + 0.8f * z;
        x = turned;
    }
    Kept kept = make_kept();
    draw_still(world, &kept);
    draw_over(world, &kept, draws, SPARKS);
    dip_samples_destroy(&kept.samples);
    dip_depth_destroy(&kept.depth);
}

// --- 8. a mirror ---------------------------------------------------------------------------------

enum { NO_COLOUR = DIP_CHANNEL_RED | DIP_CHANNEL_GREEN | DIP_CHANNEL_BLUE | DIP_CHANNEL_ALPHA };

// Draws the mirrored scene into samples and depths, without storing a picture. What is mirrored
// lies behind the mirror; the margin keeps the mirror itself.
static void draw_mirrored(World *world, const Kept *kept, const DipDraw *draws, int count) {
    DipPass pass = {
        .draws = draws,
        .draw_count = count,
        .sample_count = 4,
        .clear_lin = {0.25f, 0.42f, 0.65f},
        .clip_plane_count = 1,
        .target = {.width = WIDTH, .height = HEIGHT},
        .attachments = {.samples = kept->samples, .keep_target = true, .depth = kept->depth},
    };
    const double behind[4] = {0.0, 0.0, -1.0, -1.5 + 0.001};
    DipError err = {0};
    require(dip_matrix_clip_plane(&world->to_clip, behind, pass.clip_planes[0], &err), &err);
    require(dip_pipeline_draw(world->pipeline, &pass, NULL, NULL, &err), &err);
}

// Draws the rest over what is there, and stores the means of the samples in the picture.
static void draw_rest(World *world, const Kept *kept, const DipDraw *draws, int count) {
    const DipPass rest = {
        .draws = draws,
        .draw_count = count,
        .sample_count = 4,
        .target = {.rgba8 = &picture[0][0][0],
                   .stride_bytes = WIDTH * 4,
                   .width = WIDTH,
                   .height = HEIGHT},
        .attachments = {.samples = kept->samples,
                        .colour_load = DIP_LOAD_KEEP,
                        .depth = kept->depth,
                        .depth_load = DIP_LOAD_KEEP,
                        .stencil_load = DIP_LOAD_KEEP},
    };
    DipError err = {0};
    require(dip_pipeline_draw(world->pipeline, &rest, NULL, NULL, &err), &err);
}

// Draws the scene with a mirror in the plane z = -1.5.
static void draw_mirror(World *world) {
    static const DipDrawState mark = {
        .kept_channels = NO_COLOUR,
        .keep_depth = true,
        .stencil = {.enabled = true,
                    .reference = 1,
                    .write_mask = 255,
                    .front = {.function = DIP_COMPARE_ALWAYS, .passed = DIP_STENCIL_REPLACE}}};
    static const DipDrawState inside = {.stencil = {.enabled = true,
                                                    .reference = 1,
                                                    .read_mask = 255,
                                                    .front = {.function = DIP_COMPARE_EQUAL},
                                                    .back = {.function = DIP_COMPARE_EQUAL}}};
    static const DipDrawState glass = {.blend = DIP_BLEND_MODE_ALPHA,
                                       .depth_test = DIP_DEPTH_ALWAYS,
                                       .stencil = {.enabled = true,
                                                   .reference = 1,
                                                   .read_mask = 255,
                                                   .front = {.function = DIP_COMPARE_EQUAL}}};
    static const float tint[3] = {0.05f, 0.06f, 0.08f};
    Lit ground = lit_at(world, 0.0, 0.0, 0.0, stone);
    Lit ball = lit_at(world, 0.0, 1.0, 0.0, red);
    Lit pane = lit_at(world, 0.5, 1.2, -1.5, tint);
    pane.alpha = 0.35f;
    const DipDraw scene[2] = {lit_draw(world->ground, &ground), lit_draw(world->ball, &ball)};

    // The mirrored scene, whose triangles wind the other way round.
    const double facing[3] = {0.0, 0.0, 1.0};
    const DipMatrix reflection = dip_matrix_reflection(facing, -1.5);
    const DipMatrix mirrored_to_clip = dip_matrix_multiply(&world->to_clip, &reflection);
    Lit mirrored[2] = {ground, ball};
    DipDraw first[3] = {lit_draw(world->mirror, &pane), scene[0], scene[1]};
    first[0].state = &mark;
    for (int i = 0; i < 2; i++) {
        set_view(mirrored[i].to_clip, &mirrored[i], &mirrored_to_clip);
        first[1 + i].uniforms = &mirrored[i];
        first[1 + i].cull = DIP_CULL_FRONT;
        first[1 + i].state = &inside;
    }

    DipDraw second[3] = {lit_draw(world->mirror, &pane), scene[0], scene[1]};
    second[0].state = &glass;
    Kept kept = make_kept();
    draw_mirrored(world, &kept, first, 3);
    draw_rest(world, &kept, second, 3);
    dip_samples_destroy(&kept.samples);
    dip_depth_destroy(&kept.depth);
}

// --- the program ---------------------------------------------------------------------------------

static void write_picture(const char *folder, int number) {
    char file[512];
    snprintf(file, sizeof file, "%s/guide_%d.ppm", folder, number);
    FILE *out = fopen(file, "wb");
    if (!out) {
        perror(file);
        exit(1);
    }
    fprintf(out, "P6\n%d %d\n255\n", WIDTH, HEIGHT);
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        fwrite(&picture[0][0][0] + 4 * i, 1, 3, out);
    }
    fclose(out);
}

int main(int argc, char **argv) {
    if (argc != 2) {
        fprintf(stderr, "usage: guide FOLDER\n");
        return 2;
    }
    DipError err = {0};
    DipPool *pool = dip_pool_create(0, &err);
    require(pool != NULL, &err);
    World world = {.pipeline = dip_pipeline_create(pool, dip_isa_best(), WIDTH, HEIGHT, &err)};
    require(world.pipeline != NULL, &err);
    world.map_pipeline = dip_pipeline_create(pool, dip_isa_best(), MAP, MAP, &err);
    require(world.map_pipeline != NULL, &err);
    DipShape shape;
    require(dip_shape_sphere(&shape, 1.0f, 32, 16, &err), &err);
    world.ball = mesh_of(&shape, "ball");
    require(dip_shape_sphere(&shape, 0.06f, 12, 6, &err), &err);
    world.spark = mesh_of(&shape, "spark");
    require(dip_shape_plane(&shape, 8.0f, 8.0f, 1, 1, &err), &err);
    world.ground = mesh_of(&shape, "ground");
    require(dip_shape_quad(&shape, 3.4f, 2.4f, &err), &err);
    world.mirror = mesh_of(&shape, "mirror");
    make_camera(&world);
    make_light(&world);

    draw_triangle(world.pipeline);
    write_picture(argv[1], 1);
    static void (*const steps[])(World *) = {draw_lit,    draw_glass,  draw_outline, draw_wires,
                                             draw_shadow, draw_sparks, draw_mirror};
    for (int i = 0; i < 7; i++) {
        steps[i](&world);
        write_picture(argv[1], 2 + i);
    }
    dip_mesh_destroy(&world.ball);
    dip_mesh_destroy(&world.spark);
    dip_mesh_destroy(&world.ground);
    dip_mesh_destroy(&world.mirror);
    dip_pipeline_destroy(&world.pipeline);
    dip_pipeline_destroy(&world.map_pipeline);
    dip_pool_destroy(&pool);
    return 0;
}
