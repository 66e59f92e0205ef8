// Reads DDS files: uncompressed texels with any masks, BC1, BC2 and BC3, with the stored mip
// levels.
//
// Follows Microsoft's programming guide for DDS. Writers often set flags and pitches wrongly, so
// neither is trusted: masks say which bits are which channel, and sizes follow from the format.
#include "assets/picture/picture_private.h"

#include <string.h>

// Offsets in the file, in bytes.
enum {
    AT_SIZE = 4,
    AT_HEIGHT = 12,
    AT_WIDTH = 16,
    AT_LEVEL_COUNT = 28,
    AT_FORMAT_FLAGS = 80,
    AT_FOURCC = 84,
    AT_BIT_COUNT = 88,
    AT_MASKS = 92,
    AT_CAPS2 = 112,
    HEADER_END = 128,
    AT_DXGI_FORMAT = 128, // The header that the fourCC "DX10" announces.
    AT_DIMENSION = 132,
    AT_MISC = 136,
    AT_ARRAY_SIZE = 140,
    DX10_HEADER_END = 148
};

enum {
    FORMAT_HAS_FOURCC = 4,
    CAPS2_CUBE = 0x200,
    CAPS2_VOLUME = 0x200000,
    MISC_CUBE = 4,
    DIMENSION_2D = 3
};

typedef void DecodeBlock(const uint8_t *block, uint8_t rgba8[64]);

// How the texels are stored.
typedef struct DdsFormat {
    DecodeBlock *decode_block; // NULL: the texels are not compressed.
    size_t item_bytes;         // Size of a block or of a texel.
    uint32_t masks[4];         // Bits of red, green, blue and alpha in an uncompressed texel.
    size_t data;               // Offset of level 0 in the file.
} DdsFormat;

bool dip_picture_is_dds(const PictureFile *file) {
    return file->size_bytes >= 4 && memcmp(file->bytes, "DDS ", 4) == 0;
}

static bool refuse(const PictureFile *file, const char *what) {
    return dip_error_set(file->err, DIP_ERROR_UNSUPPORTED, file->name, 0, NULL,
                         "the DDS file holds %s, accepted one picture of uncompressed texels of 8 "
                         "to 32 bits, BC1, BC2 or BC3 (DXT1, DXT3, DXT5)",
                         what);
}

// --- the format ----------------------------------------------------------------------------------

// Formats of the DX10 header, by their numbers in DXGI_FORMAT. Whether a format is sRGB does not
// matter here, because the one who uses the picture says how its colours are encoded.
static bool read_dxgi_format(const PictureFile *file, DdsFormat *format) {
    static const uint32_t rgba[4] = {0xff, 0xff00, 0xff0000, 0xff000000};
    static const uint32_t bgra[4] = {0xff0000, 0xff00, 0xff, 0xff000000};
    static const struct {
        uint32_t first; // The numbers first..last are variants of one format.
        uint32_t last;
        DecodeBlock *decode_block;
        size_t item_bytes;
        const uint32_t *masks;
        bool opaque;
    } formats[] = {
        {28, 29, NULL, 4, rgba, false},
        {70, 72, dip_picture_decode_bc1, 8, NULL, false},
        {73, 75, dip_picture_decode_bc2, 16, NULL, false},
        {76, 78, dip_picture_decode_bc3, 16, NULL, false},
        {87, 87, NULL, 4, bgra, false},
        {88, 88, NULL, 4, bgra, true},
        {90, 91, NULL, 4, bgra, false},
        {92, 93, NULL, 4, bgra, true},
    };
    const uint32_t number = dip_picture_u32(file, AT_DXGI_FORMAT);
    for (size_t i = 0; i < sizeof formats / sizeof *formats; ++i) {
        if (number >= formats[i].first && number <= formats[i].last) {
            format->decode_block = formats[i].decode_block;
            format->item_bytes = formats[i].item_bytes;
            if (formats[i].masks) {
                memcpy(format->masks, formats[i].masks, sizeof format->masks);
                format->masks[3] = formats[i].opaque ? 0 : format->masks[3];
            }
            return true;
        }
    }
    return refuse(file, "texels of another DXGI format");
}

static bool read_dx10_header(const PictureFile *file, DdsFormat *format) {
    if (file->size_bytes < DX10_HEADER_END) {
        return dip_picture_truncated(file);
    }
    format->data = DX10_HEADER_END;
    if (dip_picture_u32(file, AT_DIMENSION) != DIMENSION_2D ||
        (dip_picture_u32(file, AT_MISC) & MISC_CUBE) || dip_picture_u32(file, AT_ARRAY_SIZE) > 1) {
        return refuse(file, "a cube map, an array or a volume");
    }
    return read_dxgi_format(file, format);
}

static bool read_fourcc(const PictureFile *file, DdsFormat *format) {
    static const struct {
        char name[5];
        DecodeBlock *decode_block;
        size_t item_bytes;
    } formats[] = {
        {"DXT1", dip_picture_decode_bc1, 8},
        {"DXT3", dip_picture_decode_bc2, 16},
        {"DXT5", dip_picture_decode_bc3, 16},
    };
    const uint8_t *fourcc = file->bytes + AT_FOURCC;
    if (memcmp(fourcc, "DX10", 4) == 0) {
        return read_dx10_header(file, format);
    }
    if (memcmp(fourcc, "DXT2", 4) == 0 || memcmp(fourcc, "DXT4", 4) == 0) {
        return refuse(file, "colours that are multiplied by alpha (DXT2 or DXT4)");
    }
    for (size_t i = 0; i < sizeof formats / sizeof *formats; ++i) {
        if (memcmp(fourcc, formats[i].name, 4) == 0) {
            format->decode_block = formats[i].decode_block;
            format->item_bytes = formats[i].item_bytes;
            return true;
        }
    }
    return refuse(file, "texels of another fourCC");
}

// Uncompressed texels. If there is only one mask besides alpha, it holds the luminance.
static bool read_masks(const PictureFile *file, DdsFormat *format) {
    const uint32_t bits = dip_picture_u32(file, AT_BIT_COUNT);
    if (bits < 8 || bits > 32 || bits % 8 != 0) {
        return refuse(file, "texels of another size");
    }
    uint32_t all = 0;
    for (size_t i = 0; i < 4; ++i) {
        format->masks[i] = dip_picture_u32(file, AT_MASKS + 4 * i);
        all |= format->masks[i];
    }
    if (!format->masks[0] || (bits < 32 && all >> bits != 0)) {
        return dip_error_set(file->err, DIP_ERROR_FORMAT, file->name, 0, NULL,
                             "the masks of the DDS file do not fit its texels of %u bits", bits);
    }
    if (!format->masks[1] && !format->masks[2]) {
        format->masks[1] = format->masks[2] = format->masks[0];
    }
    format->item_bytes = bits / 8;
    return true;
}

static bool read_format(const PictureFile *file, DdsFormat *format) {
    format->data = HEADER_END;
    if (dip_picture_u32(file, AT_CAPS2) & (CAPS2_CUBE | CAPS2_VOLUME)) {
        return refuse(file, "a cube map or a volume");
    }
    return dip_picture_u32(file, AT_FORMAT_FLAGS) & FORMAT_HAS_FOURCC ? read_fourcc(file, format)
                                                                      : read_masks(file, format);
}

// --- texels --------------------------------------------------------------------------------------

// A channel of an uncompressed texel.
typedef struct Channel {
    uint32_t mask; // 0: the file lacks the channel.
    int shift;     // Number of the channel's lowest bit.
    uint64_t max;  // Greatest value of the channel.
    uint8_t otherwise;
} Channel;

static bool make_channels(const PictureFile *file, const DdsFormat *format, Channel channels[4]) {
    for (int i = 0; i < 4; ++i) {
        const uint32_t mask = format->masks[i];
        int shift = 0;
        while (mask && !(mask >> shift & 1)) {
            ++shift;
        }
        const uint64_t max = mask >> shift;
        if (max & (max + 1)) {
            return dip_error_set(file->err, DIP_ERROR_FORMAT, file->name, 0, NULL,
                                 "the mask %08x of the DDS file has gaps", mask);
        }
        channels[i] = (Channel){mask, shift, max, i == 3 ? 255 : 0};
    }
    return true;
}

static uint8_t channel_of(const Channel *channel, uint32_t texel) {
    const uint64_t value = (texel & channel->mask) >> channel->shift;
    if (channel->max == 255) {
        return (uint8_t)value;
    }
    return channel->mask ? (uint8_t)((255 * value + channel->max / 2) / channel->max)
                         : channel->otherwise;
}

static void read_texels(const uint8_t *from, size_t texel_bytes, const Channel channels[4],
                        size_t count, uint8_t *to) {
    for (size_t i = 0; i < count; ++i) {
        uint32_t texel = 0;
        for (size_t k = 0; k < texel_bytes; ++k) {
            texel |= (uint32_t)from[i * texel_bytes + k] << 8 * k;
        }
        for (size_t k = 0; k < 4; ++k) {
            to[4 * i + k] = channel_of(&channels[k], texel);
        }
    }
}

// Blocks at the right and lower edge may reach beyond the level.
static void read_blocks(const uint8_t *from, const DdsFormat *format, int width, int height,
                        uint8_t *to) {
    for (int y = 0; y < height; y += 4) {
        for (int x = 0; x < width; x += 4) {
            uint8_t block[64];
            format->decode_block(from, block);
            from += format->item_bytes;
            const size_t columns = (size_t)(width - x < 4 ? width - x : 4);
            for (int row = 0; row < 4 && y + row < height; ++row) {
                const size_t texel = (size_t)(y + row) * (size_t)width + (size_t)x;
                memcpy(to + 4 * texel, block + 16 * row, 4 * columns);
            }
        }
    }
}

static size_t level_bytes(const DdsFormat *format, int width, int height) {
    const size_t across = (size_t)(format->decode_block ? (width + 3) / 4 : width);
    const size_t down = (size_t)(format->decode_block ? (height + 3) / 4 : height);
    return across * down * format->item_bytes;
}

static bool read_levels(const PictureFile *file, const DdsFormat *format, DipPicture *picture) {
    Channel channels[4];
    size_t offset = format->data;
    picture->has_alpha = true;
    if (!format->decode_block && !make_channels(file, format, channels)) {
        return false;
    }
    for (int level = 0; level < picture->level_count; ++level) {
        int width;
        int height;
        uint8_t *to = (uint8_t *)dip_picture_level(picture, level, &width, &height);
        const uint8_t *from = file->bytes + offset;
        if (format->decode_block) {
            read_blocks(from, format, width, height, to);
        } else {
            read_texels(from, format->item_bytes, channels, (size_t)width * (size_t)height, to);
        }
        offset += level_bytes(format, width, height);
    }
    return true;
}

// --- the file ------------------------------------------------------------------------------------

// Returns the number of levels down to 1x1.
static int full_chain(uint32_t width, uint32_t height) {
    int count = 1;
    for (uint32_t size = width > height ? width : height; size > 1; size /= 2) {
        ++count;
    }
    return count;
}

static bool holds_levels(const PictureFile *file, const DdsFormat *format, uint32_t width,
                         uint32_t height, uint32_t level_count) {
    size_t left = file->size_bytes - format->data;
    for (uint32_t level = 0; level < level_count; ++level) {
        const int w = (int)(width >> level ? width >> level : 1);
        const int h = (int)(height >> level ? height >> level : 1);
        const size_t needed = level_bytes(format, w, h);
        if (needed > left) {
            return dip_picture_truncated(file);
        }
        left -= needed;
    }
    return true;
}

bool dip_picture_read_dds(const PictureFile *file, DipPicture *picture) {
    DdsFormat format = {0};
    if (file->size_bytes < HEADER_END) {
        return dip_picture_truncated(file);
    }
    if (dip_picture_u32(file, AT_SIZE) != HEADER_END - AT_SIZE) {
        return dip_error_set(file->err, DIP_ERROR_FORMAT, file->name, 0, NULL,
                             "the header of the DDS file has %u bytes, accepted 124",
                             dip_picture_u32(file, AT_SIZE));
    }
    const uint32_t width = dip_picture_u32(file, AT_WIDTH);
    const uint32_t height = dip_picture_u32(file, AT_HEIGHT);
    const uint32_t stored = dip_picture_u32(file, AT_LEVEL_COUNT);
    const uint32_t level_count = stored ? stored : 1;
    if (!read_format(file, &format) || !dip_picture_check_size(file, width, height)) {
        return false;
    }
    if (level_count > (uint32_t)full_chain(width, height)) {
        return dip_error_set(file->err, DIP_ERROR_RANGE, file->name, 0, NULL,
                             "the DDS file has %u mip levels, accepted 1..%d for %u x %u texels",
                             level_count, full_chain(width, height), width, height);
    }
    return holds_levels(file, &format, width, height, level_count) &&
           dip_picture_allocate(file, (int)width, (int)height, (int)level_count, picture) &&
           read_levels(file, &format, picture);
}
