// The one list of the ini's keys. It yields the struct, the parser, the defaults and the table in
// docs/config.md. A test fails until that table has a row for every key.
#ifndef DIP_CONFIG_CONFIG_LIST_H
#define DIP_CONFIG_CONFIG_LIST_H

// Stands in place of a default if the ini must give the key.
#define DIP_CONFIG_REQUIRED NULL

// KEY(NAME, field, TYPE, default text or DIP_CONFIG_REQUIRED, lowest, highest, "meaning")
// CAMERA(NAME, default of the field of view, "what its path shows"): the keys CAMPATH_NAME and
//     CAMPATH_NAME_FOV
// PICTURE(NAME, level size, "level sizes in words"): a picture for one level of the mip colours
//
// Types and their fields: SIZE DipConfigSize, NUMBER double, INTEGER int, FLAG bool, FILE
// DipConfigFile, FILES DipConfigFiles (the key may be repeated), SETTINGS DipQuality, COLOR
// DipConfigColor, ISA int, NAME DipConfigName, MATERIALS and LIGHTMAPS DipConfigMaterials (these
// keys may be repeated), SHADING DipConfigShading, LIGHTS DipConfigLights (may be repeated), SCALE
// DipConfigScale. The range applies to every number of a SIZE, NUMBER, INTEGER, COLOR or SCALE. The
// default "" leaves a FILE unnamed, a NAME empty, a NUMBER at 0 and every setting of SETTINGS at
// its own default.
#define DIP_CONFIG_LIST(KEY, CAMERA, PICTURE)                                                      \
    KEY(RES, res, SIZE, DIP_CONFIG_REQUIRED, 1, 8192, "resolution of each of the two panes")       \
    KEY(REFLECTION_RES, reflection_res, SIZE, "320x240", 1, 8192,                                  \
        "resolution of the reflection's texture; a resolution above the pane's adds no detail")    \
    KEY(FOUNTAIN_WATER_LEVEL, fountain_water_level, NUMBER, "", -1e9, 1e9,                         \
        "height (y) of the water that reflects, metres; if left out: height of the lowest water")  \
    KEY(DEBUG_SHOW_REFLECTION, debug_show_reflection, FLAG, "false", 0, 0,                         \
        "true: a corner of the picture shows the reflection's texture")                            \
    KEY(WATER_SCHLICK, water_schlick, FLAG, "false", 0, 0,                                         \
        "true: water uses Schlick's approximation instead of Fresnel's equations")                 \
    KEY(XFILE, xfile, FILES, DIP_CONFIG_REQUIRED, 0, 0,                                            \
        "model file; repeat the key to load several, which share one origin")                      \
    KEY(MATERIAL_SOLID, material_solid, MATERIALS, "", 0, 0,                                       \
        "materials of ordinary surfaces, even if the model marks them otherwise")                  \
    KEY(MATERIAL_CLIP, material_clip, MATERIALS, "", 0, 0,                                         \
        "materials of surfaces that the alpha of their colour texture clips")                      \
    KEY(MATERIAL_GLASS, material_glass, MATERIALS, "", 0, 0,                                       \
        "materials of opaque surfaces that no light but a light map lights")                       \
    KEY(MATERIAL_WATER, material_water, MATERIALS, "", 0, 0,                                       \
        "materials of water, which mirrors the scene")                                             \
    KEY(MATERIAL_SKY, material_sky, MATERIALS, "", 0, 0, "materials of the sky")                   \
    KEY(MATERIAL_LIGHTMAP, material_lightmap, LIGHTMAPS, "", 0, 0,                                 \
        "materials that a light map lights, and the picture of the light map; without a picture, " \
        "the light map that the model names")                                                      \
    KEY(ANIMATION, animation, NAME, "", 0, 0, "animation of the models that plays, or `none`")     \
    KEY(CAMPATH_RESET_ON_SWITCH, campath_reset_on_switch, FLAG, "true", 0, 0,                      \
        "after a change of path, true: the new path starts at its beginning; "                     \
        "false: it goes on at the old path's time")                                                \
    CAMERA(DEFAULT, "55", "while no setting is being chosen")                                      \
    CAMERA(AA, "55", "for antialiasing")                                                           \
    CAMERA(AF, "55", "for anisotropic filtering")                                                  \
    CAMERA(TAA, "55", "for temporal antialiasing")                                                 \
    CAMERA(AAF, "55", "for advanced anisotropic filtering")                                        \
    CAMERA(AAA, "55", "for adaptive antialiasing")                                                 \
    CAMERA(CAI, "55", "for texture optimisation (Catalyst AI)")                                    \
    CAMERA(MIPLOD, "55", "for the mip level of detail")                                            \
    CAMERA(GI, "55", "for geometry instancing")                                                    \
    CAMERA(WATER, "55", "over the fountain's water")                                               \
    KEY(MIPDEBUG, mipdebug, FLAG, "false", 0, 0,                                                   \
        "true: both panes start with every mip level shown as a flat colour")                      \
    PICTURE(MIPDEBUGBASE1024, 1024, "1024 and larger")                                             \
    PICTURE(MIPDEBUG512, 512, "512")                                                               \
    PICTURE(MIPDEBUG256, 256, "256")                                                               \
    PICTURE(MIPDEBUG128, 128, "128")                                                               \
    PICTURE(MIPDEBUG64, 64, "64")                                                                  \
    PICTURE(MIPDEBUG32, 32, "32")                                                                  \
    PICTURE(MIPDEBUG16, 16, "16")                                                                  \
    PICTURE(MIPDEBUG8, 8, "8 and smaller")                                                         \
    KEY(CURRENT, current, SETTINGS, "", 0, 0, "settings of the current (left) pane at the start")  \
    KEY(REQUESTED, requested, SETTINGS, "", 0, 0,                                                  \
        "settings of the requested (right) pane at the start")                                     \
    KEY(TARGET_FPS, target_fps, NUMBER, "", 0, 1000,                                               \
        "frames a second for which the preview advises settings; 0: those of the display")         \
    KEY(THREADS, threads, INTEGER, "0", 0, 256, "worker threads; 0: one per processor")            \
    KEY(ISA, isa, ISA, "auto", 0, 0, "instruction set of the kernels")                             \
    KEY(NEAR, near_m, NUMBER, "0.1", 0.001, 100, "distance of the near plane, metres")             \
    KEY(BACKGROUND, background, COLOR, "64,64,64", 0, 255,                                         \
        "colour where no surface is seen: red, green, blue, sRGB")                                 \
    KEY(GROUND, ground, FLAG, "false", 0, 0,                                                       \
        "true: models without a ground stand on a plain one in the colour of the background")      \
    KEY(SKY_OVERCAST, sky_overcast, NUMBER, "0.5", 0, 1,                                           \
        "how much of the sky is cloud; 0: none, 1: all")                                           \
    KEY(SKY_COLOR, sky_color, COLOR, "88,135,199", 0, 255,                                         \
        "colour of the clear sky overhead: red, green, blue, sRGB")                                \
    KEY(SKY_HORIZON_COLOR, sky_horizon_color, COLOR, "142,171,211", 0, 255,                        \
        "colour of the haze at the horizon, sRGB")                                                 \
    KEY(SKY_CLOUD_COLOR, sky_cloud_color, COLOR, "243,244,247", 0, 255,                            \
        "colour of the clouds, sRGB")                                                              \
    KEY(SKY_GLARE_COLOR, sky_glare_color, COLOR, "243,225,188", 0, 255,                            \
        "colour of the sun's glare, sRGB")                                                         \
    KEY(SKY_GLARE, sky_glare, NUMBER, "0.8", 0, 10, "strength of the sun's glare")                 \
    KEY(SKY_BRIGHTNESS, sky_brightness, NUMBER, "1", 0, 10, "brightness of the whole sky")         \
    KEY(SKY_TINT, sky_tint, COLOR, "255,255,255", 0, 255,                                          \
        "colour that multiplies the whole sky, sRGB")                                              \
    KEY(SKY_CLEAR, sky_clear, NUMBER, "0.75", 0, 1,                                                \
        "value of the sky texture's blue channel that means no cloud; 1 stands for 255")           \
    KEY(SKY_DENSE, sky_dense, NUMBER, "1", 0, 1,                                                   \
        "value of the blue channel that means the densest cloud; more than SKY_CLEAR")             \
    KEY(SKY_BLEND, sky_blend, NUMBER, "0.4", 0, 1,                                                 \
        "share of the second layer of clouds; 0: only the first layer, 1: only the second")        \
    KEY(SKY_PERTURBATION_SCALE, sky_perturbation_scale, NUMBER, "1", 0.001, 1000,                  \
        "repeats of the clouds' displacement (red and green) per unit of texture coordinates")     \
    KEY(SKY_LAYER1_SCALE, sky_layer1_scale, NUMBER, "1", 0.001, 1000,                              \
        "repeats of the first layer of clouds per unit of texture coordinates")                    \
    KEY(SKY_LAYER1_SPEED, sky_layer1_speed, NUMBER, "0.3", -600, 600,                              \
        "speed of the first layer, texture widths per minute; negative: the opposite way")         \
    KEY(SKY_LAYER1_PERTURBATION, sky_layer1_perturbation, NUMBER, "0.03", -1, 1,                   \
        "greatest displacement of the first layer's clouds, texture widths")                       \
    KEY(SKY_LAYER2_SCALE, sky_layer2_scale, NUMBER, "1.7", 0.001, 1000,                            \
        "repeats of the second layer of clouds per unit of texture coordinates")                   \
    KEY(SKY_LAYER2_SPEED, sky_layer2_speed, NUMBER, "-0.2", -600, 600,                             \
        "speed of the second layer, texture widths per minute; negative: the opposite way")        \
    KEY(SKY_LAYER2_PERTURBATION, sky_layer2_perturbation, NUMBER, "0.05", -1, 1,                   \
        "greatest displacement of the second layer's clouds, texture widths")                      \
    KEY(SHADING, shading, SHADING, "auto", 0, 0,                                                   \
        "where the light of lit surfaces is computed; auto: phong in a scene with lights, and "    \
        "the "                                                                                     \
        "fixed light as it is in one without")                                                     \
    KEY(LIGHT, light, LIGHTS, "", 0, 0,                                                            \
        "light that is added to those of the models; repeat the key for more lights")              \
    KEY(AMBIENT, ambient, COLOR, "89,89,89", 0, 255,                                               \
        "light from all sides in a scene with lights: red, green, blue, sRGB; 89 is a tenth of "   \
        "white")                                                                                   \
    KEY(LIGHT_SCALE, light_scale, SCALE, "auto", 0, 1e6,                                           \
        "factor of the models' lights; 0 ignores them; auto: their light is 1 at the models' "     \
        "centre")                                                                                  \
    KEY(ENVIRONMENT, environment, FILE, "", 0, 0,                                                  \
        "Radiance HDR picture (equirectangular) that metallic-roughness surfaces reflect")         \
    KEY(ENVIRONMENT_BACKGROUND, environment_background, FLAG, "false", 0, 0,                       \
        "show the environment behind the models, instead of a background and a ground")            \
    KEY(LOG, log, FILE, "", 0, 0, "file that receives a copy of all warnings and errors")          \
    KEY(SCENE, scene, NAME, "", 0, 0,                                                              \
        "scene of the gallery that is shown instead of the models, or `tour` (docs/gallery.md)")

#endif
