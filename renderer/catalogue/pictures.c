// Draws scenes and compares pictures.
#include "renderer/catalogue/pictures.h"

#include "renderer/base/srgb.h"
#include "renderer/reference/internal/differences.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static void break_with(StabilityRun *run, const StabilityShot *shot, const DipError *err) {
    char text[320];
    dip_error_format(err, text, sizeof text);
    stability_break(run, "drawing with %s failed: %s", shot->settings, text);
}

static bool allocate(StabilityRun *run, const StabilityShot *shot, StabilityPicture *picture) {
    const size_t count = (size_t)shot->width * (size_t)shot->height * 3;
    *picture = (StabilityPicture){.width = shot->width, .height = shot->height};
    picture->rgb_lin = malloc(count * sizeof(double));
    if (!picture->rgb_lin) {
        stability_break(run, "no memory for a picture of %dx%d pixels", shot->width, shot->height);
    }
    return picture->rgb_lin != NULL;
}

void stability_decode(const DipFrame *frame, StabilityPicture *picture) {
    DipSrgbDecodeTable table;
    dip_srgb_decode_table(&table);
    for (int y = 0; y < frame->height; y++) {
        const uint8_t *row = frame->rgba8 + (size_t)y * frame->stride_bytes;
        double *out = picture->rgb_lin + (size_t)y * (size_t)frame->width * 3;
        for (int x = 0; x < frame->width; x++) {
            for (int c = 0; c < 3; c++) {
                out[3 * x + c] = table.linear[row[4 * x + c]];
            }
        }
    }
    dip_frame_hash(frame, picture->hash);
}

static DipRenderer *create_renderer(const StabilityRun *run, const StabilityShot *shot,
                                    DipError *err) {
    DipRendererDef def = dip_renderer_default_def();
    def.pool = run->pool;
    def.isa = run->isa;
    def.width = shot->width;
    def.height = shot->height;
    def.force_all_effects = shot->force_all;
    if (shot->reflection) {
        def.reflection = *shot->reflection;
    }
    return dip_quality_parse(shot->settings, &def.quality, err) ? dip_renderer_create(&def, err)
                                                                : NULL;
}

// Draws the frames before the picture, and the picture.
static bool draw_frames(const StabilityShot *shot, DipRenderer *renderer, DipScene *scene,
                        DipFrame *frame, DipError *err) {
    bool drawn = true;
    for (int before = shot->frames_before; before >= 0 && drawn; before--) {
        DipPose pose = *shot->pose;
        pose.position_world[2] += 0.02 * before;
        dip_renderer_set_frame_index(renderer, shot->frame_index - (uint64_t)before);
        drawn = dip_renderer_draw(renderer, scene, &pose, shot->time_ns, frame, err);
    }
    return drawn;
}

bool stability_draw(StabilityRun *run, const StabilityShot *shot, StabilityPicture *picture) {
    DipError err = {0};
    if (!allocate(run, shot, picture)) {
        return false;
    }
    DipScene *scene = dip_scene_create(shot->def, run->pool, &err);
    DipRenderer *renderer = scene ? create_renderer(run, shot, &err) : NULL;
    DipFrame frame;
    bool drawn = false;
    if (renderer) {
        drawn = draw_frames(shot, renderer, scene, &frame, &err);
    }
    if (drawn) {
        stability_decode(&frame, picture);
        dip_hash_text(&run->hash, picture->hash);
    } else {
        break_with(run, shot, &err);
        stability_picture_free(picture);
    }
    dip_renderer_destroy(&renderer);
    dip_scene_destroy(&scene);
    return drawn;
}

bool stability_draw_reference(StabilityRun *run, const StabilityShot *shot,
                              StabilityPicture *picture) {
    DipError err = {0};
    DipQuality quality;
    if (!allocate(run, shot, picture)) {
        return false;
    }
    DipReference *reference = dip_reference_create(shot->def, &err);
    bool drawn = reference && dip_quality_parse(shot->settings, &quality, &err);
    if (drawn && shot->share_differences) {
        drawn = dip_reference_share_differences(reference, &err);
        dip_reference_shift_readings(reference, shot->shift);
        dip_reference_interpolate_in_floats(reference, shot->in_floats);
    }
    if (drawn) {
        dip_reference_set_time(reference, shot->time_ns);
        dip_reference_set_frame_index(reference, shot->frame_index);
        if (shot->reflection) {
            dip_reference_set_reflection(reference, shot->reflection);
        }
        drawn = dip_reference_draw(reference, &quality, shot->pose, shot->width, shot->height,
                                   picture->rgb_lin, &err);
    }
    if (!drawn) {
        break_with(run, shot, &err);
        stability_picture_free(picture);
    }
    dip_reference_destroy(&reference);
    return drawn;
}

void stability_picture_free(StabilityPicture *picture) {
    free(picture->rgb_lin);
    *picture = (StabilityPicture){0};
}

double stability_rms(const StabilityPicture *a, const StabilityPicture *b) {
    const size_t count = (size_t)a->width * (size_t)a->height * 3;
    double sum = 0.0;
    for (size_t i = 0; i < count; i++) {
        const double difference = a->rgb_lin[i] - b->rgb_lin[i];
        sum += difference * difference;
    }
    return sqrt(sum / (double)count);
}

double stability_differing(const StabilityPicture *a, const StabilityPicture *b, double least) {
    const size_t count = (size_t)a->width * (size_t)a->height;
    double differing = 0.0;
    for (size_t i = 0; i < count; i++) {
        bool same = true;
        for (size_t c = 3 * i; c < 3 * i + 3; c++) {
            same = same && fabs(a->rgb_lin[c] - b->rgb_lin[c]) <= least;
        }
        differing += !same;
    }
    return differing;
}

bool stability_shows(StabilityRun *run, const StabilityPicture *picture, int least) {
    const size_t count = (size_t)picture->width * (size_t)picture->height;
    int changes = 0;
    for (size_t i = 1; i < count; i++) {
        changes +=
            memcmp(picture->rgb_lin + 3 * i, picture->rgb_lin + 3 * i - 3, 3 * sizeof(double)) != 0;
    }
    if (changes < least) {
        stability_break(run, "a picture is nearly empty: its colour changes %d times", changes);
    }
    return changes >= least;
}
