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
        "resolution of the reflection's texture")                                                  \
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
    KEY(LOG, log, FILE, "", 0, 0, "file that warnings and errors are also written to")

#endif
