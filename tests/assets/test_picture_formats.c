// Tests the readers of DDS, PCX, PPM, PGM and HDR. make_pictures.py makes the files, and reads them
// with other programs. Closed forms and stb_image are further truths.
#include "assets/importer.h"
#include "assets/picture.h"
#include "tests/assets/fixture.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>

#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#define STBI_ONLY_HDR
#define STBI_NO_STDIO
#include <stb/stb_image.h>

static const char importer_word[] = "import";

typedef struct Expected {
    const char *name;
    int width;
    int height;
    int level_count;
    bool has_alpha;
    int tolerance; // Greatest difference of a value. PIL rounds the colours of blocks otherwise.
} Expected;

static const Expected files[] = {
    {"bc1.dds", 13, 10, 4, true, 2},
    {"bc2.dds", 8, 4, 4, true, 2},
    {"bc3.dds", 13, 10, 1, true, 2},
    {"bc3_dx10.dds", 8, 8, 1, true, 2},
    {"magick_bc1.dds", 16, 16, 5, false, 2},
    {"bgra.dds", 6, 5, 3, true, 0},
    {"bgr.dds", 5, 3, 1, false, 0},
    {"bgrx.dds", 5, 3, 1, false, 0},
    {"rgba.dds", 4, 4, 3, true, 0},
    {"luminance.dds", 5, 3, 1, false, 0},
    {"luminance_alpha.dds", 5, 3, 1, true, 0},
    {"black_white.pcx", 13, 10, 1, false, 0},
    {"grey.pcx", 13, 10, 1, false, 0},
    {"palette.pcx", 13, 10, 1, false, 0},
    {"colours.pcx", 13, 10, 1, false, 0},
    {"magick.pcx", 13, 10, 1, false, 0},
    {"grey.pgm", 13, 10, 1, false, 0},
    {"colours.ppm", 13, 10, 1, false, 0},
    {"text.ppm", 13, 10, 1, false, 0},
    {"deep.ppm", 13, 10, 1, false, 0},
};
enum { FILE_COUNT = sizeof files / sizeof files[0] };

static const char *path_of(const char *name) {
    char text[FIXTURE_PATH];
    snprintf(text, sizeof text, "pictures/%s", name);
    return fixture_data(text);
}

static void assert_same_texels(const Expected *file, const DipPicture *picture) {
    char name[64];
    size_t size_bytes = 0;
    snprintf(name, sizeof name, "%s.rgba", file->name);
    uint8_t *expected = fixture_read(path_of(name), &size_bytes);
    for (size_t i = 0; i < size_bytes; ++i) {
        if (abs(expected[i] - picture->rgba8[i]) > file->tolerance) {
            fail_msg("%s: value %zu is %d, expected %d", file->name, i, picture->rgba8[i],
                     expected[i]);
        }
    }
    free(expected);
}

static void files_have_the_texels_that_other_programs_read(void **state) {
    (void)state;
    for (size_t i = 0; i < FILE_COUNT; ++i) {
        const Expected *file = &files[i];
        DipPicture picture;
        DipError err = {0};
        if (!dip_picture_read_file(path_of(file->name), &picture, &err)) {
            fail_msg("%s: %s", file->name, err.message);
        }
        assert_int_equal(picture.width, file->width);
        assert_int_equal(picture.height, file->height);
        assert_int_equal(picture.level_count, file->level_count);
        assert_int_equal(picture.has_alpha, file->has_alpha);
        assert_same_texels(file, &picture);
        dip_picture_free(&picture);
    }
}

static void assert_refused(const char *name, const uint8_t *bytes, size_t size_bytes,
                           DipErrorCode code, const char *reason) {
    DipPicture picture;
    DipError err = {0};
    uint8_t *copy = malloc(size_bytes + 1); // The sanitizer notices reads beyond it.
    memcpy(copy, bytes, size_bytes);
    const bool accepted = dip_picture_decode(copy, size_bytes, name, &picture, &err);
    free(copy);
    if (accepted || err.code != code || !strstr(err.message, reason)) {
        fail_msg("%s with %zu bytes: %s, code %s, message \"%s\"", name, size_bytes,
                 accepted ? "accepted" : "refused", dip_error_code_name(err.code), err.message);
    }
    assert_string_equal(err.file, name);
    assert_null(picture.rgba8);
}

// Every file that is cut short must be refused. A text file loses nothing with its last line feed.
static void every_cut_is_refused(void **state) {
    (void)state;
    static const char *const more[] = {"light.hdr", "flat.hdr"};
    for (size_t i = 0; i < FILE_COUNT + 2; ++i) {
        const char *name = i < FILE_COUNT ? files[i].name : more[i - FILE_COUNT];
        size_t size_bytes = 0;
        uint8_t *bytes = fixture_read(path_of(name), &size_bytes);
        size_bytes -= strcmp(name, "text.ppm") == 0 ? 8 : 0;
        for (size_t cut = 0; cut < size_bytes; ++cut) {
            DipPicture picture;
            DipError err = {0};
            if (dip_picture_decode(bytes, cut, name, &picture, &err)) {
                fail_msg("%s: accepted with %zu of %zu bytes", name, cut, size_bytes);
            }
            assert_true(err.code == DIP_ERROR_TRUNCATED || err.code == DIP_ERROR_FORMAT ||
                        err.code == DIP_ERROR_RANGE);
        }
        free(bytes);
    }
}

// A change of a file, and the error that it must give.
typedef struct Fault {
    const char *name;
    size_t offset;
    uint32_t value; // Replaces the 4 bytes at the offset.
    DipErrorCode code;
    const char *reason;
} Fault;

// A file of three bytes is no PCX file, whatever lies behind it in memory.
static void a_pcx_that_ends_before_its_bits_is_no_pcx(void **state) {
    (void)state;
    const uint8_t bytes[256] = {10, 5, 1, 8};
    for (size_t size_bytes = 1; size_bytes <= 4; ++size_bytes) {
        DipPicture picture;
        DipError err = {0};
        assert_false(dip_picture_decode(bytes, size_bytes, "short", &picture, &err));
        assert_int_equal(err.code, size_bytes < 4 ? DIP_ERROR_FORMAT : DIP_ERROR_TRUNCATED);
    }
}

// The numbers of Microsoft's DXGI_FORMAT: R8G8B8A8 UNORM and UNORM_SRGB are 28 and 29; BC1, BC2 and
// BC3 are 70 to 72, 73 to 75 and 76 to 78 (TYPELESS, UNORM, UNORM_SRGB); B8G8R8A8 is 87, 90 and 91,
// and B8G8R8X8 is 88, 92 and 93. All others are refused.
static void dds_formats_are_known_by_their_numbers(void **state) {
    (void)state;
    enum { TEXELS = 148, SIDE = 8, NUMBERS = 140 };
    size_t size_bytes = 0;
    uint8_t *file = fixture_read(path_of("bc3_dx10.dds"), &size_bytes);
    uint8_t bytes[TEXELS + 4 * SIDE * SIDE];
    memcpy(bytes, file, TEXELS);
    free(file);
    for (int i = TEXELS; i < (int)sizeof bytes; ++i) {
        bytes[i] = (uint8_t)(10 * (1 + i % 4)); // The first texel has the bytes 10, 20, 30, 40.
    }
    for (int number = 0; number < NUMBERS; ++number) {
        const bool rgba = number == 28 || number == 29;
        const bool bgra = number == 87 || number == 90 || number == 91;
        const bool bgrx = number == 88 || number == 92 || number == 93;
        const bool block = number >= 70 && number <= 78;
        DipPicture picture;
        DipError err = {0};
        bytes[128] = (uint8_t)number;
        const bool read = dip_picture_decode(bytes, sizeof bytes, "number", &picture, &err);
        if (read != (rgba || bgra || bgrx || block)) {
            fail_msg("the DXGI format %d is %s: %s", number, read ? "read" : "refused",
                     err.message);
        }
        if (read && !block) {
            const uint8_t expected[4] = {rgba ? 10 : 30, 20, rgba ? 30 : 10, bgrx ? 255 : 40};
            assert_memory_equal(picture.rgba8, expected, 4);
        }
        if (block) {
            // The first texel's alpha: its index 2 in a block of three colours (BC1) is opaque; BC2
            // has 4 bits, here 10 of 15; BC3 has the index 30 mod 8 = 6, which is 0 if the first
            // end (10) is less than the second (20).
            const uint8_t expected = number <= 72 ? 255 : number <= 75 ? 170 : 0;
            if (picture.rgba8[3] != expected) {
                fail_msg("the DXGI format %d has the alpha %d", number, picture.rgba8[3]);
            }
        }
        dip_picture_free(&picture);
    }
}

static void malformed_headers_are_refused(void **state) {
    (void)state;
    static const Fault faults[] = {
        {"bc1.dds", 4, 100, DIP_ERROR_FORMAT, "100 bytes, accepted 124"},
        {"bc1.dds", 12, 0, DIP_ERROR_RANGE, "13 x 0"},
        {"bc1.dds", 16, 8193, DIP_ERROR_RANGE, "8193 x 10"},
        {"bc1.dds", 16, 0x80000001, DIP_ERROR_RANGE, "2147483649 x 10"},
        {"bc1.dds", 12, 100, DIP_ERROR_TRUNCATED, "too early"},
        {"bc1.dds", 28, 5, DIP_ERROR_RANGE, "5 mip levels, accepted 1..4"},
        {"bc1.dds", 28, UINT32_MAX, DIP_ERROR_RANGE, "4294967295 mip levels"},
        {"bc1.dds", 84, 0x32545844, DIP_ERROR_UNSUPPORTED, "DXT2"},
        {"bc1.dds", 84, 0x74, DIP_ERROR_UNSUPPORTED, "another fourCC"},
        {"bc1.dds", 112, 0x200, DIP_ERROR_UNSUPPORTED, "cube map"},
        {"bc1.dds", 112, 0x200000, DIP_ERROR_UNSUPPORTED, "volume"},
        {"bc3_dx10.dds", 128, 98, DIP_ERROR_UNSUPPORTED, "DXGI"},
        {"bc3_dx10.dds", 132, 4, DIP_ERROR_UNSUPPORTED, "volume"},
        {"bc3_dx10.dds", 136, 4, DIP_ERROR_UNSUPPORTED, "cube map"},
        {"bc3_dx10.dds", 140, 6, DIP_ERROR_UNSUPPORTED, "array"},
        {"bgra.dds", 88, 12, DIP_ERROR_UNSUPPORTED, "another size"},
        {"bgra.dds", 88, 64, DIP_ERROR_UNSUPPORTED, "another size"},
        {"bgra.dds", 92, 0, DIP_ERROR_FORMAT, "masks"},
        {"bgra.dds", 92, 0xff00ff, DIP_ERROR_FORMAT, "gaps"},
        {"bgr.dds", 92, 0xff000000, DIP_ERROR_FORMAT, "masks"},
        {"grey.pcx", 4, 20, DIP_ERROR_RANGE, "-7 x 10"},
        {"colours.pcx", 8, 0xffff000c, DIP_ERROR_RANGE, "13 x 65536"},
        {"colours.pcx", 64, 0x00040300, DIP_ERROR_FORMAT, "lines of 4 bytes"},
        {"colours.pcx", 64, 0x000e0200, DIP_ERROR_UNSUPPORTED, "2 planes of 8 bits"},
        {"colours.pcx", 64, 0x000e0000, DIP_ERROR_UNSUPPORTED, "0 planes of 8 bits"},
    };
    for (size_t i = 0; i < sizeof faults / sizeof *faults; ++i) {
        size_t size_bytes = 0;
        uint8_t *bytes = fixture_read(path_of(faults[i].name), &size_bytes);
        memcpy(bytes + faults[i].offset, &faults[i].value, 4); // little-endian, as the files
        assert_refused(faults[i].name, bytes, size_bytes, faults[i].code, faults[i].reason);
        free(bytes);
    }
}

// Versions 0 and 3 of PCX have no palette in the file. Versions 2, 4 and 5 do; version 1 is none.
// Pixels of one bit need no palette. The picture has two pixels, with the numbers 1 and 0.
static void pcx_files_without_a_palette_are_refused(void **state) {
    (void)state;
    static const uint8_t palette[6] = {10, 20, 30, 40, 50, 60};
    for (int version = 0; version <= 6; ++version) {
        for (int bits = 1; bits <= 4; bits *= 2) {
            uint8_t bytes[130] = {10, (uint8_t)version, 1, (uint8_t)bits, 0, 0, 0, 0, 1};
            memcpy(bytes + 16, palette, sizeof palette);
            bytes[65] = 1; // plane
            bytes[66] = 2; // bytes of a line
            bytes[128] = (uint8_t)(1 << (8 - bits));
            const bool known = version <= 5 && version != 1;
            const bool has_palette = version == 2 || version >= 4 || bits == 1;
            DipPicture picture;
            DipError err = {0};
            if (dip_picture_decode(bytes, sizeof bytes, "version", &picture, &err) !=
                (known && has_palette)) {
                fail_msg("version %d, %d bits: %s", version, bits, err.message);
            }
            if (known && has_palette) {
                assert_int_equal(picture.rgba8[0], bits == 1 ? 255 : 40);
                assert_int_equal(picture.rgba8[4], bits == 1 ? 0 : 10);
            } else if (known) {
                char message[100];
                snprintf(message, sizeof message,
                         "the PCX file of version %d has no palette, accepted versions 2, 4 and 5",
                         version);
                assert_int_equal(err.code, DIP_ERROR_UNSUPPORTED);
                assert_string_equal(err.message, message);
            }
            dip_picture_free(&picture);
        }
    }
}

#ifdef DIP_HAS_WEBP
// A lossless picture of one texel, as the specification of WebP builds it: the signature 0x2f, 14
// bits each of width - 1 and height - 1, a bit of alpha, 3 bits of version, then no transform, no
// colour cache, no meta codes, and five simple codes of one symbol each (green, red, blue, alpha,
// distance), which take no further bits.
static size_t make_webp(uint8_t bytes[64]) {
    static const struct {
        uint8_t value, bits;
    } fields[] = {
        {0, 8}, {0, 6}, {0, 8}, {0, 6},  {1, 1}, {0, 3}, // 1 x 1, with alpha, version 0
        {0, 1}, {0, 1}, {0, 1},                          // no transform, cache or meta codes
        {1, 1}, {0, 1}, {1, 1}, {20, 8},                 // green: simple, one symbol of 8 bits
        {1, 1}, {0, 1}, {1, 1}, {10, 8},                 // red
        {1, 1}, {0, 1}, {1, 1}, {30, 8},                 // blue
        {1, 1}, {0, 1}, {1, 1}, {40, 8},                 // alpha
        {1, 1}, {0, 1}, {0, 1}, {0, 1},                  // distance: one symbol of 1 bit
    };
    memset(bytes, 0, 64);
    memcpy(bytes, "RIFF----WEBPVP8L----\x2f", 21);
    size_t bit = 8 * 21;
    for (size_t i = 0; i < sizeof fields / sizeof *fields; ++i) {
        for (int k = 0; k < fields[i].bits; ++k, ++bit) {
            bytes[bit / 8] = (uint8_t)(bytes[bit / 8] | (fields[i].value >> k & 1) << bit % 8);
        }
    }
    const uint32_t chunk = (uint32_t)((bit + 7) / 8 - 20);
    const uint32_t padded = chunk + chunk % 2;
    const uint32_t riff = 12 + padded;
    memcpy(bytes + 4, &riff, 4); // little-endian, as the files
    memcpy(bytes + 16, &chunk, 4);
    return 20 + padded;
}

static void a_webp_is_read_and_its_cuts_are_refused(void **state) {
    (void)state;
    uint8_t bytes[64];
    const size_t size_bytes = make_webp(bytes);
    DipPicture picture;
    DipError err = {0};
    if (!dip_picture_decode(bytes, size_bytes, "one.webp", &picture, &err)) {
        fail_msg("%s", err.message);
    }
    static const uint8_t texel[4] = {10, 20, 30, 40};
    assert_int_equal(picture.width, 1);
    assert_int_equal(picture.height, 1);
    assert_true(picture.has_alpha);
    assert_memory_equal(picture.rgba8, texel, 4);
    dip_picture_free(&picture);
    uint32_t chunk;
    memcpy(&chunk, bytes + 16, 4);
    for (size_t cut = 12; cut < 20 + chunk; ++cut) { // A shorter file is not known as WebP.
        assert_refused("cut.webp", bytes, cut, DIP_ERROR_TRUNCATED, "ends too early");
    }
    bytes[24] |= 0xe0; // another version
    assert_refused("version.webp", bytes, size_bytes, DIP_ERROR_FORMAT,
                   "malformed or an animation");
    make_webp(bytes);
    bytes[20] = 0x2e; // another signature
    assert_refused("mark.webp", bytes, size_bytes, DIP_ERROR_FORMAT, "malformed or an animation");
    make_webp(bytes);
    bytes[21] = 0xff;
    bytes[22] |= 0x3f; // 16384 texels wide
    assert_refused("wide.webp", bytes, size_bytes, DIP_ERROR_RANGE, "16384 x 1");
}

// The chunk VP8X has flags (2: animation, 16: alpha), then width - 1 and height - 1 in 24 bits
// each.
static void an_animated_webp_is_refused(void **state) {
    (void)state;
    uint8_t bytes[96] = {0};
    static const uint8_t head[] = "RIFF\x24\0\0\0WEBPVP8X\x0a\0\0\0\x02\0\0\0\x03\0\0\x03\0\0"
                                  "ANIM\x06\0\0\0\0\0\0\0\0\0";
    memcpy(bytes, head, sizeof head - 1);
    assert_refused("moving.webp", bytes, sizeof head - 1, DIP_ERROR_FORMAT,
                   "the WebP picture is malformed or an animation");
}
#endif

static void malformed_texts_are_refused(void **state) {
    (void)state;
    static const struct {
        const char *text;
        DipErrorCode code;
        const char *reason;
    } faults[] = {
        {"P5\n2 2\n0\nabcd", DIP_ERROR_RANGE, "is 0, accepted 1..65535"},
        {"P5\n2 2\n70000\nabcd", DIP_ERROR_RANGE, "malformed at byte 7"},
        {"P5\nx 2\n255\nabcd", DIP_ERROR_RANGE, "malformed at byte 3"},
        {"P5\n0 2\n255\nabcd", DIP_ERROR_RANGE, "0 x 2"},
        {"P5\n60000 60000\n255\nabcd", DIP_ERROR_RANGE, "60000 x 60000"},
        {"P5\n8000 8000\n255\nabcd", DIP_ERROR_TRUNCATED, "too early"},
        {"P5\n2 2\n50\nabcd", DIP_ERROR_RANGE, "value 97, accepted 0..50"},
        {"P2\n2 1\n50\n3 51", DIP_ERROR_RANGE, "accepted a number 0..50"},
        {"P2\n2 1\n50\n3 -1", DIP_ERROR_RANGE, "accepted a number 0..50"},
        {"P3\n1 1\n9\n1 2 # 3", DIP_ERROR_TRUNCATED, "too early"},
        {"#?RADIANCE\nFORMAT=32-bit_rle_xyze\n\n-Y 1 +X 1\nabcd", DIP_ERROR_FORMAT, "FORMAT"},
        {"#?RGBE\nFORMAT=32-bit_rle_rgbe\n\n+Y 1 +X 1\nabcd", DIP_ERROR_FORMAT, "size"},
        {"#?RGBE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 99999\nabcd", DIP_ERROR_RANGE, "99999 x 1"},
        {"#?RGBE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 999999\nabcd", DIP_ERROR_FORMAT, "size"},
        {"#?RGBE\nFORMAT=32-bit_rle_rgbe\n\n-Y 8000 +X 8000\nabcd", DIP_ERROR_TRUNCATED, "early"},
        {"#?RGBE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 1\n\1\1\1\1", DIP_ERROR_FORMAT, "old kind"},
        {"#?RGBE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 16\n\2\2\1\1.........", DIP_ERROR_FORMAT,
         "another length"},
        {"#?RGBE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 16\n\2\2\x7f\x10.........", DIP_ERROR_FORMAT,
         "another length"},
    };
    for (size_t i = 0; i < sizeof faults / sizeof *faults; ++i) {
        const char *text = faults[i].text;
        assert_refused("text", (const uint8_t *)text, strlen(text), faults[i].code,
                       faults[i].reason);
    }
}

// A run of no bytes makes stb_image read for ever.
static void malformed_runs_of_an_hdr_are_refused(void **state) {
    (void)state;
    char text[128] = "#?RGBE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 9\n\2\2";
    size_t length = strlen(text);
    const uint8_t bytes[] = {0, 9, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0};
    memcpy(text + length, bytes, sizeof bytes);
    assert_refused("empty run", (const uint8_t *)text, length + sizeof bytes, DIP_ERROR_FORMAT,
                   "does not fit its line");
    text[length + 2] = (char)(128 + 10);
    assert_refused("long run", (const uint8_t *)text, length + sizeof bytes, DIP_ERROR_FORMAT,
                   "does not fit its line");
}

// --- closed forms --------------------------------------------------------------------------------

// Makes a DDS file of one BC1 block, whose texels 0..3 have the colours 0..3.
static void make_block(uint16_t first, uint16_t second, uint8_t file[136]) {
    memset(file, 0, 136);
    memcpy(file, "DDS |", 5);
    file[12] = file[16] = 4;
    file[80] = 4;
    memcpy(file + 84, "DXT1", 4);
    const uint8_t block[8] = {(uint8_t)first,         (uint8_t)(first >> 8), (uint8_t)second,
                              (uint8_t)(second >> 8), 0xe4 /* 0, 1, 2, 3 */, 0};
    memcpy(file + 128, block, sizeof block);
}

static void colours_between_those_of_a_block_are_the_nearest(void **state) {
    (void)state;
    for (int a = 0; a < 32; ++a) {
        for (int b = 0; b < 32; ++b) {
            uint8_t file[136];
            DipPicture picture;
            make_block((uint16_t)(a << 11 | a << 6), (uint16_t)(b << 11 | b << 6), file);
            assert_true(dip_picture_decode(file, sizeof file, "block", &picture, NULL));
            const double red[2] = {a / 31.0, b / 31.0};
            const double green[2] = {2 * a / 63.0, 2 * b / 63.0};
            const double third = a > b ? 1.0 / 3.0 : 0.5;
            for (int i = 0; i < 4; ++i) {
                const double share = i == 0 ? 0.0 : i == 1 ? 1.0 : i == 2 ? third : 2.0 / 3.0;
                const bool clear = a <= b && i == 3;
                const double r = red[0] + share * (red[1] - red[0]);
                const double g = green[0] + share * (green[1] - green[0]);
                const uint8_t *texel = picture.rgba8 + 4 * i;
                // Half a code, and what the arithmetic of this test may add.
                assert_true(clear ? texel[0] == 0 : fabs(255 * r - texel[0]) < 0.5 + 1e-9);
                assert_true(clear ? texel[1] == 0 : fabs(255 * g - texel[1]) < 0.5 + 1e-9);
                assert_int_equal(texel[3], clear ? 0 : 255);
            }
            dip_picture_free(&picture);
        }
    }
}

static void values_of_a_pgm_are_scaled_to_the_nearest(void **state) {
    (void)state;
    static const uint32_t greatest[] = {1, 2, 100, 254, 255, 256, 1000, 65535};
    for (size_t i = 0; i < sizeof greatest / sizeof *greatest; ++i) {
        const uint32_t max = greatest[i];
        for (uint32_t value = 0; value <= max; value += 1 + max / 300) {
            char binary[40];
            char text[40];
            DipPicture picture;
            int length = snprintf(binary, sizeof binary, "P5 1 1 # size\n%u\n", max);
            if (max > 255) {
                binary[length++] = (char)(value >> 8);
            }
            binary[length++] = (char)value;
            snprintf(text, sizeof text, "P2 1 1 %u %u", max, value);
            const uint8_t expected = (uint8_t)floor(255.0 * value / max + 0.5);
            assert_true(
                dip_picture_decode((uint8_t *)binary, (size_t)length, "binary", &picture, NULL));
            assert_int_equal(picture.rgba8[0], expected);
            assert_int_equal(picture.rgba8[2], expected);
            dip_picture_free(&picture);
            assert_true(dip_picture_decode((uint8_t *)text, strlen(text), "text", &picture, NULL));
            assert_int_equal(picture.rgba8[1], expected);
            dip_picture_free(&picture);
        }
    }
}

static void a_565_texel_is_scaled_to_the_nearest(void **state) {
    (void)state;
    for (uint32_t value = 0; value < 65536; value += 7) {
        uint8_t file[130];
        DipPicture picture;
        const uint32_t masks[3] = {0xf800, 0x7e0, 0x1f};
        memset(file, 0, sizeof file);
        memcpy(file, "DDS |", 5);
        file[12] = file[16] = 1;
        file[80] = 0x40;
        file[88] = 16;
        memcpy(file + 92, masks, sizeof masks);
        file[128] = (uint8_t)value;
        file[129] = (uint8_t)(value >> 8);
        assert_true(dip_picture_decode(file, sizeof file, "565", &picture, NULL));
        assert_int_equal(picture.rgba8[0], (int)floor(255 * (value >> 11) / 31.0 + 0.5));
        assert_int_equal(picture.rgba8[1], (int)floor(255 * (value >> 5 & 63) / 63.0 + 0.5));
        assert_int_equal(picture.rgba8[2], (int)floor(255 * (value & 31) / 31.0 + 0.5));
        assert_int_equal(picture.rgba8[3], 255);
        dip_picture_free(&picture);
    }
}

// --- HDR -----------------------------------------------------------------------------------------

static double srgb_encode(double light) {
    return light <= 0.0031308 ? 12.92 * light : 1.055 * pow(light, 1.0 / 2.4) - 0.055;
}

// stb_image reads the floats exactly; the sRGB formula of libm says which code is the nearest.
static void light_of_an_hdr_becomes_the_nearest_code(void **state) {
    (void)state;
    static const char *const names[] = {"light.hdr", "flat.hdr"};
    bool some_cut = false;
    for (size_t f = 0; f < 2; ++f) {
        size_t size_bytes = 0;
        uint8_t *bytes = fixture_read(path_of(names[f]), &size_bytes);
        int width = 0;
        int height = 0;
        int channels = 0;
        DipPicture picture;
        float *light =
            stbi_loadf_from_memory(bytes, (int)size_bytes, &width, &height, &channels, 3);
        assert_non_null(light);
        assert_true(dip_picture_decode(bytes, size_bytes, names[f], &picture, NULL));
        assert_int_equal(picture.width, width);
        assert_int_equal(picture.height, height);
        for (int i = 0; i < 3 * width * height; ++i) {
            const double code = 255 * srgb_encode(fmin(light[i], 1.0));
            assert_true(fabs(code - picture.rgba8[4 * (i / 3) + i % 3]) <= 0.5001);
            some_cut = some_cut || light[i] > 1.0f;
        }
        dip_picture_free(&picture);
        stbi_image_free(light);
        free(bytes);
    }
    assert_true(some_cut);
}

// An environment has the light that stb_image reads, cut off far above 1.
static void an_environment_keeps_the_light(void **state) {
    (void)state;
    enum { ENV_WIDTH = 16, ENV_HEIGHT = 8 };
    uint8_t bytes[64 + 4 * ENV_WIDTH * ENV_HEIGHT];
    const int header = sprintf((char *)bytes, "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y %d +X %d\n",
                               ENV_HEIGHT, ENV_WIDTH);
    for (int i = 0; i < ENV_WIDTH * ENV_HEIGHT; ++i) {
        const uint8_t texel[4] = {(uint8_t)(9 + i), (uint8_t)(255 - i), (uint8_t)(i / 2),
                                  (uint8_t)(i == 5 ? 200 : 120 + i % 24)};
        memcpy(bytes + header + 4 * i, texel, 4);
    }
    const size_t size_bytes = (size_t)header + 4 * ENV_WIDTH * ENV_HEIGHT;
    DipError err = {0};
    DipEnvironmentDef *environment = dip_environment_decode(bytes, size_bytes, "sky.hdr", &err);
    if (!environment) {
        fail_msg("%s", err.message);
    }
    int width, height, channels;
    float *light = stbi_loadf_from_memory(bytes, (int)size_bytes, &width, &height, &channels, 3);
    assert_non_null(light);
    assert_int_equal(environment->width, width);
    assert_int_equal(environment->height, height);
    assert_true(light[3 * 5] > DIP_MAX_ENVIRONMENT_LIN);
    for (int i = 0; i < 3 * width * height; ++i) {
        assert_true(environment->rgb_lin[i] == fminf(light[i], DIP_MAX_ENVIRONMENT_LIN));
    }
    stbi_image_free(light);
    free(environment);
    assert_null(dip_environment_decode(bytes, size_bytes - 1, "sky.hdr", &err));
    assert_int_equal(err.code, DIP_ERROR_TRUNCATED);
    // Lines of 16 pixels may be packed, into 4 bytes and at least two bytes for each component.
    enum { LEAST = ENV_HEIGHT * (4 + 4 * 2) };
    for (size_t size = (size_t)header; size < (size_t)header + LEAST; ++size) {
        assert_null(dip_environment_decode(bytes, size, "sky.hdr", &err));
        assert_int_equal(err.code, DIP_ERROR_TRUNCATED);
        assert_string_equal(err.file, "sky.hdr");
    }
    bytes[header - 8] = '9'; // 9 rows of 16
    assert_null(dip_environment_decode(bytes, size_bytes, "sky.hdr", &err));
    assert_int_equal(err.code, DIP_ERROR_RANGE);
    assert_null(dip_environment_decode((const uint8_t *)"P6", 2, "sky.hdr", &err));
    assert_int_equal(err.code, DIP_ERROR_FORMAT);
}

// --- levels --------------------------------------------------------------------------------------

static void levels_become_textures(void **state) {
    (void)state;
    DipPicture picture;
    DipTextureDef levels[DIP_MAX_LEVELS];
    assert_true(dip_picture_read_file(path_of("bgra.dds"), &picture, NULL));
    assert_int_equal(dip_picture_levels(&picture, "name", DIP_ENCODING_LINEAR, levels), 3);
    static const int sizes[3][2] = {{6, 5}, {3, 2}, {1, 1}};
    const uint8_t *expected = picture.rgba8;
    for (int level = 0; level < 3; ++level) {
        assert_string_equal(levels[level].name, "name");
        assert_int_equal(levels[level].encoding, DIP_ENCODING_LINEAR);
        assert_int_equal(levels[level].width, sizes[level][0]);
        assert_int_equal(levels[level].height, sizes[level][1]);
        assert_ptr_equal(levels[level].rgba8, expected);
        expected += 4 * sizes[level][0] * sizes[level][1];
    }
    levels[2].width = 2;
    DipPicture copy;
    DipError err = {0};
    assert_false(dip_picture_copy(levels, 3, &copy, &err));
    assert_int_equal(err.code, DIP_ERROR_FORMAT);
    dip_picture_free(&picture);
}

static void the_importer_hands_over_every_level(void **state) {
    (void)state;
    const DipImporter importer = {.program = "/proc/self/exe", .command = importer_word};
    for (size_t i = 0; i < FILE_COUNT; ++i) {
        DipPicture picture;
        DipError err = {0};
        if (!dip_picture_import(path_of(files[i].name), &importer, &picture, &err)) {
            fail_msg("%s: %s", files[i].name, err.message);
        }
        assert_int_equal(picture.level_count, files[i].level_count);
        assert_int_equal(picture.has_alpha, files[i].has_alpha);
        assert_same_texels(&files[i], &picture);
        dip_picture_free(&picture);
    }
}

int main(int argc, char **argv) {
    if (argc > 1 && strcmp(argv[1], importer_word) == 0) {
        return dip_importer_run(argc - 2, argv + 2);
    }
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(files_have_the_texels_that_other_programs_read),
        cmocka_unit_test(every_cut_is_refused),
        cmocka_unit_test(a_pcx_that_ends_before_its_bits_is_no_pcx),
        cmocka_unit_test(dds_formats_are_known_by_their_numbers),
        cmocka_unit_test(malformed_headers_are_refused),
        cmocka_unit_test(pcx_files_without_a_palette_are_refused),
#ifdef DIP_HAS_WEBP
        cmocka_unit_test(a_webp_is_read_and_its_cuts_are_refused),
        cmocka_unit_test(an_animated_webp_is_refused),
#endif
        cmocka_unit_test(malformed_texts_are_refused),
        cmocka_unit_test(malformed_runs_of_an_hdr_are_refused),
        cmocka_unit_test(colours_between_those_of_a_block_are_the_nearest),
        cmocka_unit_test(values_of_a_pgm_are_scaled_to_the_nearest),
        cmocka_unit_test(a_565_texel_is_scaled_to_the_nearest),
        cmocka_unit_test(light_of_an_hdr_becomes_the_nearest_code),
        cmocka_unit_test(an_environment_keeps_the_light),
        cmocka_unit_test(levels_become_textures),
        cmocka_unit_test(the_importer_hands_over_every_level),
    };
    return cmocka_run_group_tests(tests, fixture_open, fixture_close);
}
