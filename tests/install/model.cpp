// Draws the installed courtyard from a camera path, from C++, with two settings, and measures how
// much the pictures differ (FLIP).
//
// Usage: model FOLDER (share/diptych of the installed copy)
#include <diptych/app/measure/metrics/meter.h>
#include <diptych/assets/model.h>
#include <diptych/campaths/campath.h>
#include <diptych/renderer/scene/renderer.h>

#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

enum { WIDTH = 160, HEIGHT = 120 };

static DipError err;

static void require(bool done, const char *what) {
    if (!done) {
        std::fprintf(stderr, "%s: %s\n", what, err.message);
        std::exit(1);
    }
}

static std::vector<uint8_t> draw(DipPool *pool, const DipScene *scene, const DipPose *pose,
                                 const char *settings) {
    DipRendererDef def = dip_renderer_default_def();
    def.pool = pool;
    def.width = WIDTH;
    def.height = HEIGHT;
    require(dip_quality_parse(settings, &def.quality, &err), "settings");
    DipRenderer *renderer = dip_renderer_create(&def, &err);
    DipFrame frame = {};
    require(renderer && dip_renderer_draw(renderer, scene, pose, 0, &frame, &err), "renderer");
    std::vector<uint8_t> pixels;
    for (int y = 0; y < HEIGHT; y++) {
        const uint8_t *row = frame.rgba8 + (size_t)y * frame.stride_bytes;
        pixels.insert(pixels.end(), row, row + 4 * WIDTH);
    }
    dip_renderer_destroy(&renderer);
    return pixels;
}

static double flip_between(const std::vector<uint8_t> &test, const std::vector<uint8_t> &truth) {
    DipMeter meter = {};
    DipMeterStandard standard = {};
    standard.picture = {truth.data(), 4 * WIDTH, WIDTH, HEIGHT};
    const DipSrgbPicture picture = {test.data(), 4 * WIDTH, WIDTH, HEIGHT};
    DipMetricSums sums = {};
    require(dip_meter_init(&meter, DIP_METER_FLIP, WIDTH, HEIGHT, DIP_FLIP_PIXELS_PER_DEGREE) &&
                dip_meter_add(&meter, &picture, nullptr, &standard, &sums),
            "meter");
    dip_meter_free(&meter);
    return dip_metrics_of(&sums, 0).flip;
}

int main(int argc, char **argv) {
    require(argc == 2, "usage");
    const std::string folder = argv[1];
    const std::string file = folder + "/assets/courtyard/court.gltf";
    const char *files[1] = {file.c_str()};
    DipPool *pool = dip_pool_create(2, &err);
    DipModel *model = dip_model_load(files, 1, pool, nullptr, &err);
    require(model != nullptr, "model");
    DipScene *scene = dip_scene_create(dip_model_scene_def(model), pool, &err);
    require(scene != nullptr, "scene");
    DipCamPath *path = nullptr;
    require(dip_campath_load((folder + "/campaths/aa.pth").c_str(), &path, &err), "path");
    DipPose pose = {};
    pose.fov_y_deg = 50.0;
    dip_campath_sample(path, 0, &pose);
    const std::vector<uint8_t> rough = draw(pool, scene, &pose, "aa=none");
    const std::vector<uint8_t> fine = draw(pool, scene, &pose, "aa=8,af=16");
    const double same = flip_between(fine, fine);
    const double different = flip_between(rough, fine);
    std::printf("FLIP %.4f, of equal pictures %.4f\n", different, same);
    dip_campath_destroy(&path);
    dip_scene_destroy(&scene);
    dip_model_destroy(&model);
    dip_pool_destroy(&pool);
    return same == 0.0 && different > 0.01 && different < 0.5 ? 0 : 1;
}
