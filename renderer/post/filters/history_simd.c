// Temporal antialiasing: finds the past of a row's pixels, limits it to the colours of the new
// picture around them, and blends.
#include "renderer/post/filters/pixels_simd.h"
#include "renderer/post/filters/post_kernels.h"
#include "renderer/simd/quads.h"
#include "renderer/simd/srgb.h"

typedef struct Colour {
    Vf channel[3]; // y, co, cg
} Colour;

VEC_INLINE Colour to_ycocg(Vf r, Vf g, Vf b) {
    const Vf ends = (r + b) * 0.25f;
    const Vf half = g * 0.5f;
    return (Colour){{ends + half, (r - b) * 0.5f, half - ends}};
}

void DIP_KERNEL(dip_kernel_history_unpack)(const uint8_t *rgba8, int width, const float *table,
                                           float *const channels[3]) {
    for (int x = 0; x < width; x += DIP_LANES) {
        const Vu pixels = vu_load_pixels(rgba8 + 4 * x, width - x);
        const Colour colour = to_ycocg(vf_gather(table, vi_channel(pixels, 0)),
                                       vf_gather(table, vi_channel(pixels, 1)),
                                       vf_gather(table, vi_channel(pixels, 2)));
        for (int c = 0; c < 3; c++) {
            vf_store(channels[c] + x, colour.channel[c]);
        }
    }
}

// Writes colours to the row's pixels.
VEC_INLINE void show(const DipHistoryRow *row, int x, const Vf rgb[3]) {
    Vi codes[3];
    for (int c = 0; c < 3; c++) {
        codes[c] = (Vi)vu_srgb_codes(row->srgb, vi_nearest(rgb[c]));
    }
    const Vu from = vu_load_pixels(row->from + 4 * x, row->width - x);
    vu_store_pixels(row->to + 4 * x, row->width - x, vu_pixels(codes, from));
}

// Converts to red, green and blue within 0..65535.
VEC_INLINE void to_rgb(const Colour *colour, Vf rgb[3]) {
    const Vf *c = colour->channel;
    const Vf unbound[3] = {c[0] + c[1] - c[2], c[0] + c[2], c[0] - c[1] - c[2]};
    for (int i = 0; i < 3; i++) {
        rgb[i] = vf_min(vf_max(unbound[i], vf_splat(0.0f)), vf_splat(65535.0f));
    }
}

VEC_INLINE Colour load(const float *const channels[3], int x) {
    return (Colour){{vf_load(channels[0] + x), vf_load(channels[1] + x), vf_load(channels[2] + x)}};
}

void DIP_KERNEL(dip_kernel_history_rest)(const DipHistoryRow *row) {
    const float count = (float)(row->summed + 1);
    for (int x = 0; x < row->width; x += DIP_LANES) {
        Colour sum = load(row->colours[1], x);
        for (int c = 0; c < 3; c++) {
            sum.channel[c] += row->summed ? vf_load(row->result[c] + x) : vf_splat(0.0f);
            vf_store(row->result[c] + x, sum.channel[c]);
        }
        if (row->to) {
            Vf rgb[3];
            const Vf *c = sum.channel;
            rgb[0] = (c[0] + c[1] - c[2]) / count;
            rgb[1] = (c[0] + c[2]) / count;
            rgb[2] = (c[0] - c[1] - c[2]) / count;
            show(row, x, rgb);
        }
    }
}

// Where pixels were in the picture before. The spline reads sixteen pixels around a place.
typedef struct Place {
    Mask exists;
    Vi index;          // of the first of them in a plane that begins at pixel (-2, -2)
    Vf part_x, part_y; // how far the place is from the second pixel of the second row to the next
} Place;

// The nearest surface of the 3x3 pixels around a pixel moves it, so that edges move with what is in
// front.
VEC_INLINE Place find_place(const DipHistoryRow *row, int x) {
    const float *m = row->to_before;
    const float width = (float)row->width;
    const float height = (float)row->height;
    Vf depth = vf_load(row->depths[1] + x);
    Vf dx = vf_splat(0.0f);
    Vf dy = vf_splat(0.0f);
    for (int i = 0; i < 9; i++) {
        if (i == 4) { // the pixel itself
            continue;
        }
        const Vf other = vf_load(row->depths[i / 3] + x + i % 3 - 1);
        const Mask nearer = vf_lt(depth, other);
        depth = vf_select(nearer, other, depth);
        dx = vf_select(nearer, vf_splat((float)(i % 3 - 1)), dx);
        dy = vf_select(nearer, vf_splat((float)(i / 3 - 1)), dy);
    }
    const Vf at_x = vf_from_int(vi_iota() + x) + dx;
    const Vf at_y = (float)row->y + dy;
    const Vf ndc_x = (at_x + 0.5f) * (2.0f / width) - 1.0f;
    const Vf ndc_y = 1.0f - (at_y + 0.5f) * (2.0f / height);
    const Vf w = ((ndc_x * m[8] + ndc_y * m[9]) + m[10]) + depth * m[11];
    const Vf before_x = ((ndc_x * m[0] + ndc_y * m[1]) + m[2]) + depth * m[3];
    const Vf before_y = ((ndc_x * m[4] + ndc_y * m[5]) + m[6]) + depth * m[7];
    const Vf inverse = 1.0f / w;
    const Vf from_x = ((before_x * inverse + 1.0f) * (0.5f * width) - 0.5f) - dx;
    const Vf from_y = ((1.0f - before_y * inverse) * (0.5f * height) - 0.5f) - dy;
    const unsigned inside = row->begins ? 0 : lanes_within(row->width - x);
    Place place = {.exists =
                       (Mask)(mask_from_bits(inside) & vf_lt(vf_splat(0.0f), w) &
                              vf_lt(vf_splat(-0.5f), from_x) & vf_lt(vf_splat(-0.5f), from_y) &
                              vf_lt(from_x, vf_splat(width - 0.5f)) &
                              vf_lt(from_y, vf_splat(height - 0.5f)))};
    const Vf valid_x = vf_select(place.exists, from_x, vf_splat(0.0f));
    const Vf valid_y = vf_select(place.exists, from_y, vf_splat(0.0f));
    const Vf floor_x = vf_floor(valid_x);
    const Vf floor_y = vf_floor(valid_y);
    place.part_x = valid_x - floor_x;
    place.part_y = valid_y - floor_y;
    place.index = (vi_from_float(floor_y) + 1) * row->plane_stride + (vi_from_float(floor_x) + 1);
    return place;
}

// The weights of Catmull-Rom for the pixels -1, 0, 1 and 2.
VEC_INLINE void weights_of(Vf t, Vf weights[4]) {
    weights[0] = t * (t * (1.0f - t * 0.5f) - 0.5f);
    weights[1] = t * t * (t * 1.5f - 2.5f) + 1.0f;
    weights[2] = t * (t * (2.0f - t * 1.5f) + 0.5f);
    weights[3] = t * t * (t * 0.5f - 0.5f);
}

// How the places of a vector's pixels lie. They mostly follow each other in a row, or do so on both
// sides of a step.
typedef enum Lie { IN_LINE, IN_TWO_LINES, SCATTERED } Lie;

// Where a vector's pixels have their places.
typedef struct Reach {
    Lie lie;
    int first;     // index of lane 0, if all places lie in its line
    int other;     // the same of the second line
    Mask on_first; // lanes of the first line
    int32_t index[DIP_LANES];
} Reach;

// Returns the lanes whose places lie in one line with that of lane `lane`.
VEC_INLINE unsigned lanes_in_line(Vi starts, int lane) {
    return mask_bits(vi_eq(starts, vi_splat(starts[lane])));
}

VEC_INLINE Reach reach_of(const Place *place) {
    const Vi starts = place->index - vi_iota();
    const unsigned exist = mask_bits(place->exists);
    const int lane = __builtin_ctz(exist);
    const unsigned on_first = lanes_in_line(starts, lane);
    const unsigned others = exist & ~on_first;
    Reach reach = {.lie = IN_LINE, .first = starts[lane], .on_first = mask_from_bits(on_first)};
    if (others) {
        const int next = __builtin_ctz(others);
        reach.other = starts[next];
        reach.lie = others & ~lanes_in_line(starts, next) ? SCATTERED : IN_TWO_LINES;
        vi_store(reach.index, place->index);
    }
    return reach;
}

// Returns four pixels of a row for each lane.
VEC_INLINE void read_four(const float *from, const Reach *reach, Lie lie, Vf values[4]) {
    if (lie == SCATTERED) {
        Vu quads[4];
        for (int k = 0; k < 4; k++) {
            quads[k] = vu_load_quads((const uint32_t *)(const void *)from, 1, reach->index, k);
        }
        vf_split_quads(quads, values);
        return;
    }
    for (int i = 0; i < 4; i++) {
        values[i] = vf_load(from + reach->first + i);
        if (lie == IN_TWO_LINES) {
            values[i] = vf_select(reach->on_first, values[i], vf_load(from + reach->other + i));
        }
    }
}

// Returns the past of the pixels.
VEC_INLINE Colour sample_at(const DipHistoryRow *row, const Place *place, const Reach *reach,
                            Lie lie) {
    Colour past;
    Vf weights_x[4];
    Vf weights_y[4];
    weights_of(place->part_x, weights_x);
    weights_of(place->part_y, weights_y);
    for (int c = 0; c < 3; c++) {
        Vf sum = vf_splat(0.0f);
        for (int j = 0; j < 4; j++) {
            Vf values[4];
            read_four(row->past[c] + (ptrdiff_t)(j - 2) * row->plane_stride - 2, reach, lie,
                      values);
            Vf line = values[0] * weights_x[0];
            for (int i = 1; i < 4; i++) {
                line += values[i] * weights_x[i];
            }
            sum += line * weights_y[j];
        }
        past.channel[c] = sum * row->past_scale;
    }
    return past;
}

VEC_INLINE Colour sample(const DipHistoryRow *row, const Place *place) {
    const Reach reach = reach_of(place);
    switch (reach.lie) {
    case IN_LINE:
        return sample_at(row, place, &reach, IN_LINE);
    case IN_TWO_LINES:
        return sample_at(row, place, &reach, IN_TWO_LINES);
    default:
        return sample_at(row, place, &reach, SCATTERED);
    }
}

// Moves a colour towards the mean of the 3x3 new pixels until no channel is farther from it than
// the channel's standard deviation.
VEC_INLINE void limit(const DipHistoryRow *row, int x, const Colour *centre, Colour *past) {
    Vf means[3];
    Vf farthest = vf_splat(1.0f);
    for (int c = 0; c < 3; c++) {
        Vf sum = vf_splat(0.0f);
        Vf squares = vf_splat(0.0f);
        for (int i = 0; i < 9; i++) {
            if (i == 4) { // the colour itself
                continue;
            }
            const Vf off = vf_load(row->colours[i / 3][c] + x + i % 3 - 1) - centre->channel[c];
            sum += off;
            squares += off * off;
        }
        const Vf mean = sum * (1.0f / 9.0f);
        const Vf variance = squares * (1.0f / 9.0f) - mean * mean;
        const Vf deviation = vf_sqrt(vf_max(variance, vf_splat(0.0f)));
        means[c] = centre->channel[c] + mean;
        const Vf distance = vf_abs(past->channel[c] - means[c]);
        farthest = vf_max(farthest, distance / vf_max(deviation, vf_splat(0.0625f)));
    }
    const Vf share = 1.0f / farthest;
    for (int c = 0; c < 3; c++) {
        past->channel[c] = means[c] + (past->channel[c] - means[c]) * share;
    }
}

// Returns the new colours, blended with their past where it exists.
VEC_INLINE Colour blend(const DipHistoryRow *row, int x, const Place *place) {
    const Colour fresh = load(row->colours[1], x);
    if (!mask_any(place->exists)) {
        return fresh;
    }
    Colour past = sample(row, place);
    Colour result;
    limit(row, x, &fresh, &past);
    for (int c = 0; c < 3; c++) {
        const Vf blended = past.channel[c] + (fresh.channel[c] - past.channel[c]) * row->alpha;
        result.channel[c] = vf_select(place->exists, blended, fresh.channel[c]);
    }
    return result;
}

unsigned DIP_KERNEL(dip_kernel_history_move)(const DipHistoryRow *row) {
    unsigned reprojected = 0;
    for (int x = 0; x < row->width; x += DIP_LANES) {
        const Place place = find_place(row, x);
        const Colour result = blend(row, x, &place);
        Vf rgb[3];
        to_rgb(&result, rgb);
        const Colour stored = to_ycocg(rgb[0], rgb[1], rgb[2]);
        for (int c = 0; c < 3; c++) {
            vf_store(row->result[c] + x, stored.channel[c]);
        }
        show(row, x, rgb);
        reprojected += (unsigned)__builtin_popcount(mask_bits(place.exists));
    }
    return reprojected;
}
