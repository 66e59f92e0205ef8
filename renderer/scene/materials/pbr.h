// What the shader of metallic-roughness surfaces reads: the numbers of a surface and the tables
// that all of them share. docs/picture.md, Metal and gloss, defines the formulas.
#ifndef DIP_RENDERER_SCENE_MATERIALS_PBR_H
#define DIP_RENDERER_SCENE_MATERIALS_PBR_H

#include <stdbool.h>
#include <stdint.h>

enum { DIP_PBR_TABLE = 32 }; // entries of a table along each axis

// Shares of reflected light, as whole numbers of 1/65535. Entry i of an axis is the value at
// (i + 0.5) / DIP_PBR_TABLE.
typedef struct DipPbrTables {
    // A and B over roughness (slow) and n.v (fast): A in the low 16 bits, B in the high ones.
    int32_t lobe[DIP_PBR_TABLE * DIP_PBR_TABLE];
    // Over n.v: the mean of (1 - v.h)^5 over the directions of diffuse light, in the low 16 bits,
    // and the next entry's in the high ones. The last entry's next is itself.
    int32_t grazing[DIP_PBR_TABLE];
} DipPbrTables;

enum { DIP_PBR_SAMPLES = 256 };

// A Hammersley point: its first coordinate, and the cosine and sine of the azimuth that the second
// one gives.
typedef struct DipPbrSample {
    double u;
    double cosine;
    double sine;
} DipPbrSample;

// Makes the points by which the lobe is integrated, with + - * / and sqrt alone.
void dip_pbr_samples_make(DipPbrSample samples[DIP_PBR_SAMPLES]);

// Returns the tables, which all scenes share. They are computed by the first call, with + - * / and
// sqrt alone, so that they are the same on every machine. Several threads may call this function.
const DipPbrTables *dip_pbr_tables(void);

// The sheen of cloth. All but its colour follows from its roughness.
typedef struct DipSheen {
    float lin[3];
    float greatest;     // the greatest of them
    float exponent;     // of Charlie's distribution, for the squared sine
    float scale;        // of the distribution
    float albedo_slope; // log2 of the albedo is cosine * slope + shift
    float albedo_shift;
} DipSheen;

// Describes a sheen. roughness: 0..1.
DipSheen dip_sheen_make(const float lin[3], double roughness);

// A metallic-roughness surface. The index of a varying is the first of two texture coordinates, or
// DIP_ABSENT if the surface has no such map.
typedef struct DipPbrUniforms {
    const DipPbrTables *tables;
    const struct DipEnvironmentMap *environment; // NULL: the surroundings of the lighting
    float metallic;
    float roughness;
    float f0_lin[3];    // reflected share at normal incidence of what is not metal
    float f0_greatest;  // the greatest of them
    float f90;          // reflected share at grazing incidence of what is not metal
    float normal_scale; // of the normal map
    int metal_rough_varying;
    int occlusion_varying;
    int emission_varying;
    bool occlusion_in_metal_rough; // the red of the metal_rough map is the occlusion
    bool emits;
    bool two_sided;  // the normal is turned where the surface is seen from behind
    bool own_lights; // the scene's lights light the surface; false: the fixed light does
    float occlusion_strength;
    float emission_lin[3];
    float coat;
    float coat_roughness;
    const DipSheen *sheen; // NULL: there is none
    float transmission;    // share of what would be diffuse light that is let through
    float scattering;      // of what is let through; 0 unless roughness blurs it
} DipPbrUniforms;

#endif
