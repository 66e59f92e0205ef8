// Compressed textures: encodes the colours of every level as BC1 and decodes them again, on many
// threads.
//
// The result has the same layout as any other texture. A bilinear read therefore costs one load. If
// the kernels read BC1 blocks, each read of a texel would have to compute the block's four colours,
// select one by the texel's index, and decode it from sRGB. A CPU has no hardware for this
// decoding. So BC1 changes the picture here as it does on a graphics card, but it saves neither
// time nor memory.
#include "renderer/pipeline/texture/texture_layout.h"

#include "renderer/base/fp_mode.h"
#include "renderer/pipeline/bc1.h"

#include <stdlib.h>

// A level that is being compressed. Each task compresses one row of blocks.
typedef struct Level {
    const DipTexture *from;
    DipTexture *to;
    int level;
    int first_task; // index of the task that compresses the level's first row of blocks
} Level;

typedef struct Job {
    Level *levels;
    int level_count;
    int task_count;
    DipRootCodes codes;
    DipBc1Light light;
} Job;

// Reads the 4x4 texels of the block whose first texel is (x, y). The last column and row of the
// level are repeated beyond its edges.
static void read_block(const DipRootCodes *codes, const DipTexture *texture, int level, int x,
                       int y, uint8_t rgba8[64]) {
    const int width = texture->level_width[level];
    const int height = texture->level_height[level];
    const size_t stride = dip_texture_stride(texture, level);
    const DipTexelPair *texels = texture->texels + texture->level_offset[level];
    for (int j = 0; j < DIP_BC1_SIDE; j++) {
        const int row_index = y + j < height ? y + j : height - 1;
        const DipTexelPair *row = texels + (size_t)row_index * stride;
        for (int i = 0; i < DIP_BC1_SIDE; i++, rgba8 += 4) {
            dip_root_codes_read(codes, row[x + i < width ? x + i : width - 1].here, rgba8);
            rgba8[3] = 255;
        }
    }
}

static void write_block(const DipBc1Light *light, DipTexture *texture, int level, int x, int y,
                        const uint8_t block[DIP_BC1_BYTES]) {
    const int width = texture->level_width[level];
    const int height = texture->level_height[level];
    const size_t stride = dip_texture_stride(texture, level);
    DipTexelPair *texels = texture->texels + texture->level_offset[level];
    uint32_t palette[4];
    dip_bc1_palette(light, block, palette);
    for (int i = 0; i < 16; i++) {
        const int column = x + (i & 3);
        const int row = y + (i >> 2);
        if (column < width && row < height) {
            texels[(size_t)row * stride + (size_t)column].here = palette[dip_bc1_choice(block, i)];
        }
    }
}

static const Level *level_of(const Job *job, int task) {
    int low = 0;
    int high = job->level_count;
    while (high - low > 1) {
        const int middle = (low + high) / 2;
        if (job->levels[middle].first_task <= task) {
            low = middle;
        } else {
            high = middle;
        }
    }
    return &job->levels[low];
}

static void make_row(void *context, int index, int worker) {
    (void)worker;
    const Job *job = context;
    const Level *level = level_of(job, index);
    const int height = level->from->level_height[level->level];
    const int y = (index - level->first_task) * DIP_BC1_SIDE;
    for (int x = 0; x < level->from->level_width[level->level]; x += DIP_BC1_SIDE) {
        uint8_t rgba8[64];
        uint8_t block[DIP_BC1_BYTES];
        read_block(&job->codes, level->from, level->level, x, y, rgba8);
        dip_bc1_encode(rgba8, block);
        write_block(&job->light, level->to, level->level, x, y, block);
    }
    for (int row = y; row < y + DIP_BC1_SIDE && row < height; row++) {
        dip_texture_finish_row(level->to, level->level, row);
    }
}

// Creates a texture with the layout of `from`, without alpha. Its texels are not yet filled in.
static DipTexture *begin_texture(const DipTexture *from) {
    DipTexture *texture = malloc(sizeof *texture);
    if (texture) {
        *texture = *from;
        texture->alpha = NULL;
        texture->shares_alpha = true;
        if (!dip_texture_allocate(texture)) {
            dip_texture_destroy(&texture);
        }
    }
    return texture;
}

static void add_levels(Job *job, const DipTexture *from, DipTexture *to) {
    for (int level = 0; level < from->level_count; level++) {
        job->levels[job->level_count++] = (Level){from, to, level, job->task_count};
        job->task_count += (from->level_height[level] + DIP_BC1_SIDE - 1) / DIP_BC1_SIDE;
    }
}

bool dip_textures_compress(DipTexture *const *textures, const bool *wanted, int count,
                           DipPool *pool, DipTexture **compressed, DipError *err) {
    DIP_FP_MODE_SCOPE();
    Job *job = calloc(1, sizeof *job);
    bool made = job != NULL;
    if (made) {
        job->levels = malloc(((size_t)count * DIP_MAX_LEVELS + 1) * sizeof *job->levels);
        made = job->levels != NULL;
    }
    for (int i = 0; i < count; i++) {
        compressed[i] = NULL;
        if (made && wanted[i]) {
            compressed[i] = begin_texture(textures[i]);
            made = compressed[i] != NULL;
        }
        if (compressed[i]) {
            add_levels(job, textures[i], compressed[i]);
        }
    }
    if (made) {
        dip_root_codes_fill(&job->codes);
        dip_bc1_light_fill(&job->light);
        dip_pool_run(pool, job->task_count, make_row, job);
    } else {
        dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "textures",
                      "no memory for compressed textures");
    }
    for (int i = 0; i < count; i++) {
        if (!made) {
            dip_texture_destroy(&compressed[i]);
        } else if (compressed[i]) {
            compressed[i]->alpha = textures[i]->alpha;
        }
    }
    if (job) {
        free(job->levels);
    }
    free(job);
    return made;
}
