// The one list of the ini's keys. It yields the struct, the parser, the defaults and the table in
// docs/config.md (whose test fails until a new key stands there too).
#ifndef DIP_CONFIG_CONFIG_LIST_H
#define DIP_CONFIG_CONFIG_LIST_H

// What stands for a default where there is none: the key must be given.
#define DIP_CONFIG_REQUIRED NULL

// KEY(NAME, field, TYPE, default text or DIP_CONFIG_REQUIRED, lowest, highest, "what it is")
// CAMERA(NAME, default text of the path, "what its path shows"): CAMPATH_NAME and CAMPATH_NAME_FOV
// PICTURE(NAME, level size, "what it is"): a file for one level of the mip-debug pictures
//
// Types and their fields: SIZE DipConfigSize, NUMBER double, INTEGER int, FLAG bool, FILE
// DipConfigFile ("" for none), FILES DipConfigFiles (may be repeated), SETTINGS DipQuality, COLOR
// DipConfigColor, ISA int. Ranges hold for every number of SIZE, NUMBER, INTEGER and COLOR.
#define DIP_CONFIG_LIST(KEY, CAMERA, PICTURE)                                                      \
    KEY(RES, res, SIZE, DIP_CONFIG_REQUIRED, 1, 8192, "resolution of each of the two panes")       \
    KEY(REFLECTION_RES, reflection_res, SIZE, DIP_CONFIG_REQUIRED, 1, 8192,                        \
        "resolution of the reflection's texture; beyond the pane's own it shows nothing more")     \
    KEY(FOUNTAIN_WATER_LEVEL, fountain_water_level, NUMBER, DIP_CONFIG_REQUIRED, -1e9, 1e9,        \
        "height (y) of the water that reflects, metres")                                           \
    KEY(DEBUG_SHOW_REFLECTION, debug_show_reflection, FLAG, DIP_CONFIG_REQUIRED, 0, 0,             \
        "show the reflection's texture in the picture's corner")                                   \
    KEY(WATER_SCHLICK, water_schlick, FLAG, "false", 0, 0,                                         \
        "water reflects by Schlick's approximation instead of Fresnel's equations")                \
    KEY(XFILE, xfile, FILES, DIP_CONFIG_REQUIRED, 0, 0,                                            \
        "model file; repeat the key to load several, all about the origin")                        \
    KEY(CAMPATH_RESET_ON_SWITCH, campath_reset_on_switch, FLAG, DIP_CONFIG_REQUIRED, 0, 0,         \
        "a switch of path begins the new one at its beginning")                                    \
    CAMERA(DEFAULT, DIP_CONFIG_REQUIRED, "when no setting is being chosen")                        \
    CAMERA(AA, DIP_CONFIG_REQUIRED, "for antialiasing")                                            \
    CAMERA(AF, DIP_CONFIG_REQUIRED, "for anisotropic filtering")                                   \
    CAMERA(TAA, DIP_CONFIG_REQUIRED, "for temporal antialiasing")                                  \
    CAMERA(AAF, DIP_CONFIG_REQUIRED, "for advanced anisotropic filtering")                         \
    CAMERA(AAA, DIP_CONFIG_REQUIRED, "for adaptive antialiasing")                                  \
    CAMERA(CAI, DIP_CONFIG_REQUIRED, "for texture optimisation (Catalyst AI)")                     \
    CAMERA(MIPLOD, DIP_CONFIG_REQUIRED, "for the mip level of detail")                             \
    CAMERA(GI, DIP_CONFIG_REQUIRED, "for geometry instancing")                                     \
    CAMERA(WATER, "", "over the fountain's water")                                                 \
    KEY(MIPDEBUG, mipdebug, FLAG, DIP_CONFIG_REQUIRED, 0, 0,                                       \
        "begin with mip levels shown as flat colours, in both panes")                              \
    PICTURE(MIPDEBUGBASE1024, 1024, "1024 and larger")                                             \
    PICTURE(MIPDEBUG512, 512, "512")                                                               \
    PICTURE(MIPDEBUG256, 256, "256")                                                               \
    PICTURE(MIPDEBUG128, 128, "128")                                                               \
    PICTURE(MIPDEBUG64, 64, "64")                                                                  \
    PICTURE(MIPDEBUG32, 32, "32")                                                                  \
    PICTURE(MIPDEBUG16, 16, "16")                                                                  \
    PICTURE(MIPDEBUG8, 8, "8 and smaller")                                                         \
    KEY(CURRENT, current, SETTINGS, "", 0, 0, "settings the current (left) pane begins with")      \
    KEY(REQUESTED, requested, SETTINGS, "", 0, 0,                                                  \
        "settings the requested (right) pane begins with")                                         \
    KEY(THREADS, threads, INTEGER, "0", 0, 256, "worker threads, 0: one per processor")            \
    KEY(ISA, isa, ISA, "auto", 0, 0, "instruction set of the kernels")                             \
    KEY(NEAR, near_m, NUMBER, "0.1", 0.001, 100, "distance of the near plane, metres")             \
    KEY(BACKGROUND, background, COLOR, "64,64,64", 0, 255,                                         \
        "colour where nothing is: red, green, blue, sRGB")                                         \
    KEY(SKY_OVERCAST, sky_overcast, NUMBER, "0.5", 0, 1,                                           \
        "how much of the sky is cloud, 0: none, 1: all")                                           \
    KEY(SKY_COLOR, sky_color, COLOR, "88,135,199", 0, 255,                                         \
        "colour of the clear sky overhead: red, green, blue, sRGB")                                \
    KEY(SKY_HORIZON_COLOR, sky_horizon_color, COLOR, "142,171,211", 0, 255,                        \
        "colour of the haze at the horizon")                                                       \
    KEY(SKY_CLOUD_COLOR, sky_cloud_color, COLOR, "243,244,247", 0, 255, "colour of the clouds")    \
    KEY(SKY_GLARE_COLOR, sky_glare_color, COLOR, "243,225,188", 0, 255,                            \
        "colour of the sun's glare")                                                               \
    KEY(SKY_GLARE, sky_glare, NUMBER, "0.8", 0, 10, "strength of the sun's glare")                 \
    KEY(SKY_BRIGHTNESS, sky_brightness, NUMBER, "1", 0, 10, "brightness of all of the sky")        \
    KEY(SKY_TINT, sky_tint, COLOR, "255,255,255", 0, 255, "tint of all of the sky")                \
    KEY(SKY_CLEAR, sky_clear, NUMBER, "0.75", 0, 1,                                                \
        "blue of the sky's texture where there is no cloud")                                       \
    KEY(SKY_DENSE, sky_dense, NUMBER, "1", 0, 1,                                                   \
        "blue where cloud is densest, more than SKY_CLEAR")                                        \
    KEY(SKY_BLEND, sky_blend, NUMBER, "0.4", 0, 1, "share of the second layer")                    \
    KEY(SKY_PERTURBATION_SCALE, sky_perturbation_scale, NUMBER, "1", 0.001, 1000,                  \
        "repeats of red and green, which displace clouds, per unit of texture coordinates")        \
    KEY(SKY_LAYER1_SCALE, sky_layer1_scale, NUMBER, "1", 0.001, 1000,                              \
        "repeats of the first layer per unit of texture coordinates")                              \
    KEY(SKY_LAYER1_SPEED, sky_layer1_speed, NUMBER, "0.3", -600, 600,                              \
        "its speed, texture widths a minute; negative: the other way")                             \
    KEY(SKY_LAYER1_PERTURBATION, sky_layer1_perturbation, NUMBER, "0.03", -1, 1,                   \
        "how far its clouds are displaced at most, texture widths")                                \
    KEY(SKY_LAYER2_SCALE, sky_layer2_scale, NUMBER, "1.7", 0.001, 1000,                            \
        "repeats of the second layer per unit of texture coordinates")                             \
    KEY(SKY_LAYER2_SPEED, sky_layer2_speed, NUMBER, "-0.2", -600, 600,                             \
        "its speed, texture widths a minute; negative: the other way")                             \
    KEY(SKY_LAYER2_PERTURBATION, sky_layer2_perturbation, NUMBER, "0.05", -1, 1,                   \
        "how far its clouds are displaced at most, texture widths")                                \
    KEY(LOG, log, FILE, "", 0, 0, "file that warnings and errors are also written to")

#endif
