// Shades a triangle at a position: interpolation, derivatives, textures, light.
#include "renderer/reference/internal/differences.h"
#include "renderer/reference/internal/internal.h"

#include <math.h>

double dip_reference_depth(const DipRefPosition *place, double near_m) {
    const DipRefTriangle *triangle = place->triangle;
    double sum = 0.0;
    for (int i = 0; i < 3; i++) {
        sum += place->edges[i] * triangle->vertices[i].inv_w;
    }
    return near_m * sum / triangle->area;
}

// U = u/w and Q = 1/w are linear on the screen, so u = U/Q and du/dx = (dU/dx - u dQ/dx) / Q. The
// edge functions are the weights of the vertices, up to a common factor that cancels out. Edge i
// lies opposite vertex i and runs from vertex i+1 to i+2. It changes by -dy per step in x and by
// +dx per step in y.
void dip_reference_interpolate(const DipRefPosition *place, int first, int count, bool derive,
                               DipRefVaryings *out) {
    const DipRefVertex *v = place->triangle->vertices;
    double weights[3], weights_dx[3], weights_dy[3];
    double q = 0.0, q_dx = 0.0, q_dy = 0.0;
    for (int i = 0; i < 3; i++) {
        const DipRefVertex *from = &v[(i + 1) % 3];
        const DipRefVertex *to = &v[(i + 2) % 3];
        const double steps_inv_w = 256.0 * v[i].inv_w; // derivatives are per pixel
        weights[i] = place->edges[i] * v[i].inv_w;
        weights_dx[i] = (from->y - to->y) * steps_inv_w;
        weights_dy[i] = (to->x - from->x) * steps_inv_w;
        q += weights[i];
        q_dx += weights_dx[i];
        q_dy += weights_dy[i];
    }
    out->depth_change = (fabs(q_dx) + fabs(q_dy)) / fabs(q);
    out->triangle = place->triangle;
    out->beyond_horizon = q * place->triangle->area < 0.0;
    for (int k = first; k < first + count; k++) {
        const double a = v[0].varyings[k], b = v[1].varyings[k], c = v[2].varyings[k];
        const double value = (weights[0] * a + weights[1] * b + weights[2] * c) / q;
        out->value[k] = value;
        if (derive && k < DIP_REF_DERIVED) {
            out->ddx[k] =
                (weights_dx[0] * a + weights_dx[1] * b + weights_dx[2] * c - value * q_dx) / q;
            out->ddy[k] =
                (weights_dy[0] * a + weights_dy[1] * b + weights_dy[2] * c - value * q_dy) / q;
        }
    }
    if (place->triangle->in_floats) {
        dip_reference_interpolate_floats(place, first, count, derive, out);
    }
}

void dip_reference_ray(const DipRefVaryings *varyings, double ray[3]) {
    for (int i = 0; i < 3; i++) {
        const double place = varyings->value[DIP_REF_X + i];
        ray[i] = varyings->beyond_horizon ? -place : place;
    }
}

static void read_texture(const DipRefTexture *texture, const DipRefFilter *filter,
                         const DipRefVaryings *varyings, int coordinate, double rgba[4]) {
    if (filter) {
        dip_reference_sample(texture, filter, &varyings->value[coordinate],
                             &varyings->ddx[coordinate], &varyings->ddy[coordinate], rgba);
    } else {
        dip_reference_sample_finest(texture, &varyings->value[coordinate], rgba);
    }
}

double dip_reference_alpha(const DipRefPosition *place, const DipRefFilter *filter) {
    const DipRefTexture *colour = place->triangle->colour;
    DipRefVaryings varyings;
    double rgba[4] = {1.0, 1.0, 1.0, 1.0};
    dip_reference_interpolate(place, DIP_REF_U0, DIP_REF_ALPHA + 1, filter != NULL, &varyings);
    if (colour) {
        read_texture(colour, filter, &varyings, DIP_REF_U0, rgba);
    }
    return rgba[3] * fmin(fmax(varyings.value[DIP_REF_ALPHA], 0.0), 1.0);
}

double dip_reference_alpha_slope(const DipRefPosition *place, const DipRefFilter *filter,
                                 double *slope) {
    const DipRefTexture *colour = place->triangle->colour;
    DipRefVaryings varyings;
    double rgba[4] = {1.0, 1.0, 1.0, 1.0};
    dip_reference_interpolate(place, DIP_REF_U0, DIP_REF_ALPHA + 1, true, &varyings);
    *slope = 0.0;
    if (colour) {
        dip_reference_sample_slope(colour, filter, &varyings.value[DIP_REF_U0],
                                   &varyings.ddx[DIP_REF_U0], &varyings.ddy[DIP_REF_U0], rgba,
                                   slope);
    }
    // The changes of both factors are added.
    const double own = fmin(fmax(varyings.value[DIP_REF_ALPHA], 0.0), 1.0);
    const double change = fabs(varyings.ddx[DIP_REF_ALPHA]) + fabs(varyings.ddy[DIP_REF_ALPHA]);
    *slope = *slope * own + rgba[3] * change;
    return rgba[3] * own;
}

double dip_reference_opacity(const DipRefPosition *place, const DipRefFilter *filter) {
    const DipRefTriangle *triangle = place->triangle;
    if (!triangle->blended) {
        return 1.0;
    }
    if (triangle->water) {
        return 1.0 - (double)triangle->material->transmission;
    }
    // Where its metallic-roughness description is not drawn, transmission is a lower opacity.
    const DipPbrDef *pbr = triangle->pbr ? NULL : triangle->material->pbr;
    return dip_reference_alpha(place, filter) * triangle->material->opacity *
           (1.0 - (pbr ? (double)pbr->transmission : 0.0));
}

void dip_reference_read_data(const DipRefTexture *map, const DipRefFilter *filter,
                             const DipRefVaryings *varyings, int coordinate, double texel[4]) {
    const DipRefFilter own = filter ? dip_reference_data_filter(filter) : (DipRefFilter){0};
    read_texture(map, filter ? &own : NULL, varyings, coordinate, texel);
}

// Lights a surface's own colour by the lights of the scene. texel: its normal map's, or NULL.
// sunlit: the part of the light with shadows that arrives.
static void add_lights(const DipRefTriangle *triangle, const DipRefVaryings *varyings,
                       const double texel[3], double sunlit, double rgb[3]) {
    double diffuse[3] = {1.0, 1.0, 1.0}; // At vertices, RED to BLUE have it already.
    double highlight[3];
    double normal[3];
    double ray[3];
    if (triangle->lit.fragments) {
        dip_reference_normal(varyings, texel, 1.0, normal);
        dip_reference_ray(varyings, ray);
        dip_reference_lights(&triangle->lit, &varyings->value[DIP_REF_X], ray, normal, sunlit,
                             diffuse, highlight, NULL);
    }
    for (int c = 0; c < 3; c++) {
        const double added = triangle->lit.fragments
                                 ? highlight[c]
                                 : sunlit * varyings->value[DIP_REF_HIGHLIGHT_RED + c];
        rgb[c] = rgb[c] * diffuse[c] + added;
    }
}

void dip_reference_shade(const DipRefPosition *place, const DipRefFilter *filter, double rgb[3]) {
    const DipRefTriangle *triangle = place->triangle;
    const DipMaterialDef *material = triangle->material;
    DipRefVaryings varyings;
    const bool needs_plane = triangle->pbr && material->double_sided;
    dip_reference_interpolate(place, 0, DIP_REF_VARYINGS,
                              filter || triangle->normal_map || needs_plane, &varyings);
    const bool mip_colours = filter && filter->mip_colours && triangle->colour;
    if (triangle->sky && !mip_colours) {
        dip_reference_shade_sky(triangle, filter, &varyings, rgb);
        return;
    }
    double colour[4] = {1.0, 1.0, 1.0, 1.0};
    double light[4] = {1.0, 1.0, 1.0, 1.0};
    double scale = 1.0;
    if (triangle->colour) {
        read_texture(triangle->colour, filter, &varyings, DIP_REF_U0, colour);
    }
    if (triangle->light_map) {
        const DipRefFilter trilinear = dip_reference_light_map_filter();
        read_texture(triangle->light_map, filter ? &trilinear : NULL, &varyings, DIP_REF_U1, light);
        scale = material->light_map_scale;
    }
    const double sunlit = triangle->lit.lighting && !triangle->pbr
                              ? dip_reference_sunlit(&triangle->lit, &varyings.value[DIP_REF_X])
                              : 1.0;
    for (int c = 0; c < 3; c++) {
        const double base = mip_colours ? 1.0 : material->base_colour_lin[c];
        const double lit =
            varyings.value[DIP_REF_RED + c] + sunlit * varyings.value[DIP_REF_DIRECT_RED + c];
        rgb[c] = base * lit * colour[c];
        light[c] *= scale;
    }
    double texel[4];
    if (triangle->normal_map) {
        dip_reference_read_data(triangle->normal_map, filter, &varyings, DIP_REF_U0, texel);
    }
    if (triangle->pbr) {
        dip_reference_shade_pbr(triangle, filter, &varyings, triangle->normal_map ? texel : NULL,
                                rgb);
    } else if (triangle->lit.lighting) {
        add_lights(triangle, &varyings, triangle->normal_map ? texel : NULL, sunlit, rgb);
    } else if (triangle->normal_map) {
        dip_reference_light_bumps(material, &varyings, texel, triangle->light_map ? light : NULL,
                                  rgb);
    }
    for (int c = 0; c < 3; c++) {
        const double value = triangle->normal_map ? rgb[c] : rgb[c] * light[c];
        rgb[c] = fmin(fmax(value, 0.0), 1.0);
    }
}

bool dip_reference_scatters(const DipRefTriangle *triangle) {
    const DipPbrDef *pbr = triangle->blended ? triangle->pbr : NULL;
    return pbr && pbr->transmission > 0.0f && pbr->roughness * pbr->scattering > 0.1f;
}

void dip_reference_see_through(const DipRefPosition *place, const DipRefFilter *filter,
                               const DipRefBackdrop *backdrop, double layer[DIP_REF_LAYER]) {
    const DipRefTriangle *triangle = place->triangle;
    for (int c = 0; c < 3; c++) {
        layer[4 + c] = 1.0 - layer[3];
    }
    if (!triangle->blended || !triangle->pbr || !(triangle->pbr->transmission > 0.0f)) {
        return;
    }
    DipRefVaryings varyings;
    double colour[4] = {1.0, 1.0, 1.0, 1.0};
    double texel[4];
    double through[3];
    dip_reference_interpolate(place, 0, DIP_REF_VARYINGS, true, &varyings);
    const bool mip_colours = filter && filter->mip_colours && triangle->colour;
    if (triangle->colour) {
        read_texture(triangle->colour, filter, &varyings, DIP_REF_U0, colour);
    }
    if (triangle->normal_map) {
        dip_reference_read_data(triangle->normal_map, filter, &varyings, DIP_REF_U0, texel);
    }
    for (int c = 0; c < 3; c++) {
        const double base = mip_colours ? 1.0 : triangle->material->base_colour_lin[c];
        colour[c] *= base * varyings.value[DIP_REF_RED + c];
    }
    const double roughness = dip_reference_transmit_pbr(
        triangle, filter, &varyings, triangle->normal_map ? texel : NULL, colour, through);
    if (backdrop && dip_reference_scatters(triangle)) {
        double behind[3];
        dip_reference_backdrop_read(backdrop, place, roughness * (double)triangle->pbr->scattering,
                                    behind);
        for (int c = 0; c < 3; c++) {
            layer[c] = fmin(layer[c] + through[c] * behind[c], 1.0);
        }
        return;
    }
    for (int c = 0; c < 3; c++) {
        layer[4 + c] += layer[3] * through[c];
    }
}
