// Builds textures on many threads: decodes the pictures, filters the mip chains, packs and pads the
// levels.
#include "renderer/pipeline/texture/texture_layout.h"

#include "renderer/base/fp_mode.h"
#include "renderer/base/pages.h"
#include "renderer/base/srgb.h"
#include "renderer/pipeline/bc1.h"
#include "renderer/pipeline/texture/mip.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { FULL_CODE16 = 65535, FULL_CODE10 = 1023 };

static uint32_t quantise(double linear, int max) {
    const double clamped = linear > 0.0 ? (linear < 1.0 ? linear : 1.0) : 0.0;
    // The conversion goes through a signed integer, because vector instructions convert only to
    // signed numbers.
    return (uint32_t)(int32_t)(sqrt(clamped) * max + 0.5);
}

// The lowest 5 bits of the halves for red and green belong to blue (`low`). Returns the multiple of
// 32, for the upper 11 bits, that is closest to code16 after `low` is added.
static uint32_t beside(uint32_t code16, uint32_t low) {
    const uint32_t at = code16 + 16 < low ? 0 : (code16 + 16 - low) & ~31u;
    return at > 65504 ? 65504 : at;
}

// Packs a texel from square roots of linear light: 16 bits for red and green, 10 bits for blue.
static uint32_t join_codes(uint32_t red16, uint32_t green16, uint32_t blue10) {
    const uint32_t high = blue10 >> 5;
    const uint32_t low = blue10 & 31;
    return (beside(red16, high) | high) << 16 | beside(green16, low) | low;
}

static uint32_t pack_texel(const double rgb_lin[3]) {
    return join_codes(quantise(rgb_lin[0], FULL_CODE16), quantise(rgb_lin[1], FULL_CODE16),
                      quantise(rgb_lin[2], FULL_CODE10));
}

uint32_t dip_texel_pack(const double rgb_lin[3]) {
    DIP_FP_MODE_SCOPE();
    return pack_texel(rgb_lin);
}

static bool check_wrap(const DipTextureDef *def, const char *key, DipWrap wrap, DipError *err) {
    return (unsigned)wrap < DIP_WRAP_COUNT ||
           dip_error_set(err, DIP_ERROR_RANGE, def->name, 0, key, "%d, accepted 0..%d", (int)wrap,
                         DIP_WRAP_COUNT - 1);
}

static bool check_def(const DipTextureDef *def, DipError *err) {
    if (!def) {
        return dip_error_set(err, DIP_ERROR_MISSING, NULL, 0, "texture", "NULL");
    }
    if (def->width < 1 || def->height < 1 || def->width > DIP_MAX_TEXTURE_SIZE ||
        def->height > DIP_MAX_TEXTURE_SIZE) {
        return dip_error_set(err, DIP_ERROR_RANGE, def->name, 0, "texture",
                             "%dx%d texels, accepted 1x1 to %dx%d", def->width, def->height,
                             DIP_MAX_TEXTURE_SIZE, DIP_MAX_TEXTURE_SIZE);
    }
    if (!def->rgba8) {
        return dip_error_set(err, DIP_ERROR_MISSING, def->name, 0, "rgba8", "NULL");
    }
    if ((unsigned)def->encoding > DIP_ENCODING_LINEAR) {
        return dip_error_set(err, DIP_ERROR_RANGE, def->name, 0, "encoding", "%d, accepted 0..%d",
                             (int)def->encoding, DIP_ENCODING_LINEAR);
    }
    return check_wrap(def, "wrap_u", def->wrap_u, err) &&
           check_wrap(def, "wrap_v", def->wrap_v, err);
}

// A few thousand texels are checked at a time, so that the inner loop has no branches.
bool dip_texture_has_alpha(const DipTextureDef *def) {
    const size_t count = (size_t)def->width * (size_t)def->height;
    uint8_t all = 255;
    for (size_t i = 0; i < count && all == 255;) {
        const size_t end = count - i < 4096 ? count : i + 4096;
        for (; i < end; i++) {
            all &= def->rgba8[4 * i + 3];
        }
    }
    return all != 255;
}

static void add_levels(DipTexture *texture) {
    int width = texture->width;
    int height = texture->height;
    for (;;) {
        dip_texture_add_level(texture, width, height);
        if (width == 1 && height == 1) {
            return;
        }
        width = dip_mip_next_size(width);
        height = dip_mip_next_size(height);
    }
}

// Tables for the 256 possible values (codes) of a picture's channel: the linear light or alpha for
// the mip filter, and the square roots of linear light for packed texels.
typedef struct CodeTables {
    float colour[256];
    float alpha[256];
    uint32_t code16[256];
    uint32_t code10[256];
} CodeTables;

static void fill_code_tables(CodeTables *tables, DipEncoding encoding) {
    DipSrgbDecodeTable srgb;
    dip_srgb_decode_table(&srgb);
    for (int i = 0; i < 256; i++) {
        tables->alpha[i] = (float)(i / 255.0);
        tables->colour[i] =
            encoding == DIP_ENCODING_SRGB ? (float)srgb.linear[i] : tables->alpha[i];
        const double light = tables->colour[i];
        tables->code16[i] = quantise(light, FULL_CODE16);
        tables->code10[i] = quantise(light, FULL_CODE10);
    }
}

static uint32_t pack_code(const CodeTables *tables, const uint8_t *code) {
    return join_codes(tables->code16[code[0]], tables->code16[code[1]], tables->code10[code[2]]);
}

// Packs rows first..end-1 of a level, and the padding that repeats their texels, directly from the
// 8-bit values of the level's picture.
static void pack_codes(DipTexture *texture, int level, const DipTextureDef *def,
                       const CodeTables *tables, int first, int end) {
    for (int y = first; y < end; y++) {
        const size_t position =
            (size_t)texture->level_offset[level] + (size_t)y * dip_texture_stride(texture, level);
        const uint8_t *code = def->rgba8 + (size_t)y * (size_t)def->width * 4;
        DipTexelPair *texels = texture->texels + position;
        for (int x = 0; x < def->width; x++) {
            texels[x].here = pack_code(tables, code + 4 * (size_t)x);
        }
        for (int x = 0; texture->alpha && x < def->width; x++) {
            texture->alpha[position + (size_t)x].here = code[4 * (size_t)x + 3];
        }
        dip_texture_finish_row(texture, level, y);
    }
}

// Packs a row of a filtered level, without its padding.
static void pack_row(const float *row, int width, DipTexelPair *restrict texels,
                     DipAlphaPair *restrict alpha) {
    for (int x = 0; x < width; x++) {
        const double rgb[3] = {row[x], row[width + x], row[2 * width + x]};
        texels[x].here = pack_texel(rgb);
    }
    for (int x = 0; alpha && x < width; x++) {
        alpha[x].here = (uint8_t)(row[3 * width + x] * 255.0f + 0.5f);
    }
}

// --- chains ------------------------------------------------------------------------------------

// A mip chain is made in two parts. The first part packs level 0 directly from the picture's 8-bit
// values and filters level 1 from them, row by row. This part is divided into bands. The second
// part, called the rest, makes the levels from 2 on, which is a third of the work. One task makes
// the rest while other threads work on the bands of the next texture.
enum { BAND_TEXELS = 1 << 16 }; // approximate number of texels of level 0 in a band

// A texture that is being built.
typedef struct Chain {
    const DipTextureDef *def;
    DipTexture *texture;
    const CodeTables *tables;
    float *level1; // rows of floats (mip.h); level2 follows level1 in the same block of memory
    float *level2;
    int band_rows; // number of rows of level 1 in a band
    int band_count;
} Chain;

typedef struct ChainJobs {
    Chain *bands; // the chain whose bands are tasks 1 and up, or NULL
    Chain *rest;  // the chain whose levels from 2 on are task 0, or NULL
    float *rows;  // space for three rows of level 0 for each worker
    size_t row_floats;
} ChainJobs;

static void decode_row(const uint8_t *codes, int width, const CodeTables *tables,
                       float *restrict to) {
    for (int x = 0; x < width; x++) {
        to[x] = tables->colour[codes[4 * x]];
        to[width + x] = tables->colour[codes[4 * x + 1]];
        to[2 * width + x] = tables->colour[codes[4 * x + 2]];
        to[3 * width + x] = tables->alpha[codes[4 * x + 3]];
    }
}

// Packs a row of a filtered level, and the padding that repeats its texels.
static void store_row(DipTexture *texture, int level, int y, const float *row) {
    const int width = texture->level_width[level];
    const size_t position =
        (size_t)texture->level_offset[level] + (size_t)y * dip_texture_stride(texture, level);
    pack_row(row, width, texture->texels + position,
             texture->alpha ? texture->alpha + position : NULL);
    dip_texture_finish_row(texture, level, y);
}

// Makes a band: packs its rows of level 0, and filters its rows of level 1 from them.
static void make_band(const Chain *chain, int band, float *scratch) {
    DipTexture *texture = chain->texture;
    const int width = texture->width;
    const int next_height = texture->level_height[1];
    const int first = band * chain->band_rows;
    const bool last_band = band == chain->band_count - 1;
    const int end = last_band ? next_height : first + chain->band_rows;
    pack_codes(texture, 0, chain->def, chain->tables,
               dip_mip_tap(first, texture->height, next_height).first,
               last_band ? texture->height : dip_mip_tap(end, texture->height, next_height).first);
    for (int y = first; y < end; y++) {
        const DipMipTap tap = dip_mip_tap(y, texture->height, next_height);
        const float *rows[DIP_MIP_MAX_TAPS] = {0};
        for (int i = 0; i < tap.count; i++) {
            float *row = scratch + (size_t)i * DIP_MIP_CHANNELS * (size_t)width;
            decode_row(chain->def->rgba8 + (size_t)(tap.first + i) * (size_t)width * 4, width,
                       chain->tables, row);
            rows[i] = row;
        }
        const int next_width = texture->level_width[1];
        float *to = chain->level1 + (size_t)y * DIP_MIP_CHANNELS * (size_t)next_width;
        dip_mip_halve_row(&tap, rows, width, to, next_width);
        store_row(texture, 1, y, to);
    }
}

// Makes every level from 2 on. Only two unpacked levels are in memory at a time.
static void make_rest(const Chain *chain) {
    DipTexture *texture = chain->texture;
    DipMipLevel from = {texture->level_width[1], texture->level_height[1], chain->level1};
    DipMipLevel to = {0, 0, chain->level2};
    for (int level = 2; level < texture->level_count; level++) {
        to.width = texture->level_width[level];
        to.height = texture->level_height[level];
        dip_mip_halve(&from, &to);
        for (int y = 0; y < to.height; y++) {
            store_row(texture, level, y, to.rows + (size_t)y * DIP_MIP_CHANNELS * (size_t)to.width);
        }
        const DipMipLevel swap = from;
        from = to;
        to = swap;
    }
}

static void run_chain_task(void *context, int index, int worker) {
    const ChainJobs *jobs = context;
    if (index > 0) {
        make_band(jobs->bands, index - 1, jobs->rows + (size_t)worker * jobs->row_floats);
    } else if (jobs->rest) {
        make_rest(jobs->rest);
    }
}

static DipTexture *out_of_memory(DipTexture *texture, const char *name, DipError *err) {
    dip_texture_destroy(&texture);
    dip_error_set(err, DIP_ERROR_MEMORY, name, 0, "texture", "out of memory");
    return NULL;
}

static bool border_shows_through(const DipTextureDef *def) {
    return (def->wrap_u == DIP_WRAP_BORDER || def->wrap_v == DIP_WRAP_BORDER) &&
           def->border_rgba8[3] != 255;
}

static bool allocate(DipTexture *texture, bool with_alpha) {
    if (with_alpha) {
        texture->alpha = dip_texture_allocate_alpha(texture);
    }
    return dip_texture_allocate(texture) && (texture->alpha || !with_alpha);
}

// Creates a texture with the layout of its levels. Its texels are not yet filled in.
static DipTexture *begin_texture(const DipTextureDef *def, bool keep_alpha,
                                 const CodeTables *tables, DipError *err) {
    DipTexture *texture = calloc(1, sizeof *texture);
    if (!texture) {
        return out_of_memory(NULL, def->name, err);
    }
    texture->width = def->width;
    texture->height = def->height;
    texture->encoding = def->encoding;
    texture->keeps_alpha = keep_alpha;
    texture->border = pack_code(tables, def->border_rgba8);
    texture->border_alpha = def->border_rgba8[3];
    dip_texture_set_wrap(texture, def);
    add_levels(texture);
    const bool with_alpha = keep_alpha && (border_shows_through(def) || dip_texture_has_alpha(def));
    return allocate(texture, with_alpha) ? texture : out_of_memory(texture, def->name, err);
}

// Allocates the rows of floats from which a chain is filtered, and divides it into bands.
static bool begin_chain(Chain *chain, const DipTextureDef *def, DipTexture *texture,
                        const CodeTables tables[2]) {
    *chain = (Chain){def, texture, &tables[def->encoding], NULL, NULL, 0, 0};
    if (texture->level_count == 1) {
        return true;
    }
    size_t floats[2] = {0, 0};
    for (int i = 0; i < 2 && i + 1 < texture->level_count; i++) {
        floats[i] = (size_t)DIP_MIP_CHANNELS * (size_t)texture->level_width[i + 1] *
                    (size_t)texture->level_height[i + 1];
    }
    chain->level1 = dip_pages_alloc((floats[0] + floats[1]) * sizeof(float));
    if (!chain->level1) {
        return false;
    }
    chain->level2 = chain->level1 + floats[0];
    const int rows = BAND_TEXELS / 2 / def->width;
    chain->band_rows = rows > 1 ? rows : 1;
    chain->band_count = (texture->level_height[1] + chain->band_rows - 1) / chain->band_rows;
    return true;
}

// Creates a texture and the chain that fills it.
static bool begin(Chain *chain, const DipTextureDef *def, bool keep_alpha,
                  const CodeTables tables[2], DipError *err) {
    chain->texture = NULL;
    if (!check_def(def, err)) {
        return false;
    }
    DipTexture *texture = begin_texture(def, keep_alpha, &tables[def->encoding], err);
    if (!texture) {
        return false;
    }
    if (!begin_chain(chain, def, texture, tables)) {
        chain->texture = out_of_memory(texture, def->name, err);
        return false;
    }
    return true;
}

// Allocates the rows and code tables that the tasks of all textures share.
static bool begin_jobs(ChainJobs *jobs, CodeTables **tables, const DipTextureDef *defs,
                       const bool *used, int count, DipPool *pool) {
    int widest = 1;
    for (int i = 0; i < count; i++) {
        widest = (!used || used[i]) && defs[i].width > widest ? defs[i].width : widest;
    }
    widest = widest < DIP_MAX_TEXTURE_SIZE ? widest : DIP_MAX_TEXTURE_SIZE;
    const size_t workers = pool ? (size_t)dip_pool_thread_count(pool) : 1;
    jobs->row_floats = (size_t)DIP_MIP_MAX_TAPS * DIP_MIP_CHANNELS * (size_t)widest;
    jobs->rows = malloc(workers * jobs->row_floats * sizeof *jobs->rows);
    *tables = malloc(2 * sizeof **tables);
    if (!jobs->rows || !*tables) {
        return false;
    }
    fill_code_tables(&(*tables)[DIP_ENCODING_SRGB], DIP_ENCODING_SRGB);
    fill_code_tables(&(*tables)[DIP_ENCODING_LINEAR], DIP_ENCODING_LINEAR);
    return true;
}

// Makes the bands of jobs->bands and, at the same time, the levels from 2 on of jobs->rest, which
// is the previous chain. Afterwards the function frees the float rows of the previous chain.
static void run_chains(ChainJobs *jobs, DipPool *pool) {
    dip_pool_run(pool, 1 + (jobs->bands ? jobs->bands->band_count : 0), run_chain_task, jobs);
    if (jobs->rest) {
        dip_lines_free(jobs->rest->level1);
    }
    jobs->rest = jobs->bands;
    jobs->bands = NULL;
}

// Makes level 0 of a chain and, if it has one, level 1; and the rest of the chain before it.
static void run_first_levels(ChainJobs *jobs, Chain *chain, DipPool *pool) {
    if (chain->level1) {
        jobs->bands = chain;
        run_chains(jobs, pool);
    } else {
        pack_codes(chain->texture, 0, chain->def, chain->tables, 0, chain->def->height);
    }
}

bool dip_textures_create(const DipTextureDef *defs, const bool *used, const bool *keep_alpha,
                         int count, DipPool *pool, DipTexture **textures, DipError *err) {
    DIP_FP_MODE_SCOPE();
    ChainJobs jobs = {NULL, NULL, NULL, 0};
    CodeTables *tables = NULL;
    Chain chains[2];
    bool made = begin_jobs(&jobs, &tables, defs, used, count, pool);
    if (!made) {
        out_of_memory(NULL, count ? defs[0].name : NULL, err);
    }
    for (int i = 0; i < count; i++) {
        textures[i] = NULL;
    }
    for (int i = 0, turn = 0; made && i < count; i++) {
        if (used && !used[i]) {
            continue;
        }
        Chain *chain = &chains[turn & 1];
        made = begin(chain, &defs[i], !keep_alpha || keep_alpha[i], tables, err);
        textures[i] = chain->texture;
        if (made) {
            turn += chain->level1 != NULL;
            run_first_levels(&jobs, chain, pool);
        }
    }
    run_chains(&jobs, pool);
    free(jobs.rows);
    free(tables);
    for (int i = 0; !made && i < count; i++) {
        dip_texture_destroy(&textures[i]);
    }
    return made;
}

DipTexture *dip_texture_create(const DipTextureDef *def, DipError *err) {
    DipTexture *texture;
    return check_def(def, err) && dip_textures_create(def, NULL, NULL, 1, NULL, &texture, err)
               ? texture
               : NULL;
}

static bool check_levels(const DipTextureDef *levels, int level_count, DipError *err) {
    if (level_count < 1 || level_count > DIP_MAX_LEVELS) {
        return dip_error_set(err, DIP_ERROR_RANGE, NULL, 0, "level_count", "%d, accepted 1..%d",
                             level_count, DIP_MAX_LEVELS);
    }
    for (int i = 0; i < level_count; i++) {
        if (!check_def(levels ? &levels[i] : NULL, err)) {
            return false;
        }
    }
    return true;
}

DipTexture *dip_texture_create_from_levels(const DipTextureDef *levels, int level_count,
                                           DipError *err) {
    DIP_FP_MODE_SCOPE();
    if (!check_levels(levels, level_count, err)) {
        return NULL;
    }
    DipTexture *texture = calloc(1, sizeof *texture);
    if (!texture) {
        return out_of_memory(NULL, levels[0].name, err);
    }
    CodeTables tables;
    fill_code_tables(&tables, levels[0].encoding);
    texture->width = levels[0].width;
    texture->height = levels[0].height;
    texture->encoding = levels[0].encoding;
    texture->stored_levels = true;
    texture->border = pack_code(&tables, levels[0].border_rgba8);
    texture->border_alpha = levels[0].border_rgba8[3];
    dip_texture_set_wrap(texture, &levels[0]);
    bool with_alpha = border_shows_through(&levels[0]);
    for (int i = 0; i < level_count; i++) {
        dip_texture_add_level(texture, levels[i].width, levels[i].height);
        with_alpha = with_alpha || dip_texture_has_alpha(&levels[i]);
    }
    if (!allocate(texture, with_alpha)) {
        return out_of_memory(texture, levels[0].name, err);
    }
    for (int i = 0; i < level_count; i++) {
        fill_code_tables(&tables, levels[i].encoding);
        pack_codes(texture, i, &levels[i], &tables, 0, levels[i].height);
    }
    return texture;
}

bool dip_texture_rebuild(DipTexture *texture, const DipTextureDef *def, DipPool *pool,
                         DipError *err) {
    ChainJobs jobs = {NULL, NULL, NULL, 0};
    CodeTables *tables = NULL;
    Chain chain = {.level1 = NULL};
    const bool needs_alpha = texture->keeps_alpha && !texture->alpha && dip_texture_has_alpha(def);
    DipAlphaPair *alpha = needs_alpha ? dip_texture_allocate_alpha(texture) : NULL;
    const bool made = (alpha || !needs_alpha) && begin_jobs(&jobs, &tables, def, NULL, 1, pool) &&
                      begin_chain(&chain, def, texture, tables);
    if (made) {
        texture->alpha = needs_alpha ? alpha : texture->alpha;
        run_first_levels(&jobs, &chain, pool);
        run_chains(&jobs, pool);
    } else {
        free(alpha);
        out_of_memory(NULL, def->name, err);
    }
    free(jobs.rows);
    free(tables);
    return made;
}

void dip_texture_destroy(DipTexture **texture) {
    if (*texture) {
        dip_lines_free((*texture)->texels);
        if (!(*texture)->shares_alpha) {
            free((*texture)->alpha);
        }
        free(*texture);
        *texture = NULL;
    }
}

int dip_texture_level_count(const DipTexture *texture) {
    return texture->level_count;
}

void dip_texture_level_size(const DipTexture *texture, int level, int *width, int *height) {
    *width = texture->level_width[level];
    *height = texture->level_height[level];
}

uint64_t dip_texture_colour_bytes(const DipTexture *texture) {
    return texture ? texture->texel_count * sizeof *texture->texels : 0;
}

uint64_t dip_texture_alpha_bytes(const DipTexture *texture) {
    return texture && texture->alpha && !texture->shares_alpha
               ? texture->texel_count * sizeof *texture->alpha
               : 0;
}
