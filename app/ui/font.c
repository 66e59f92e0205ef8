// Finds the font with fontconfig, draws glyphs with FreeType, and keeps drawn glyphs in a cache.
#include "app/ui/font.h"

#include "renderer/base/utf8.h"

#include <fontconfig/fontconfig.h>
#include <ft2build.h>
#include FT_FREETYPE_H

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// The cache is a hash table with open addressing. It is emptied when it is three quarters full.
// This bounds the cache's memory even if the window's size changes often.
enum { GLYPH_SLOTS = 4096, MAX_GLYPHS = GLYPH_SLOTS / 4 * 3 };

static const char ellipsis[] = "\xe2\x80\xa6";
static const uint32_t replacement_character = 0xfffd;

typedef struct Glyph {
    uint32_t key; // Code point and size; 0 marks an empty slot.
    int left;     // Distance from the pen to the mask's left edge, in pixels.
    int top;      // Distance from the baseline up to the mask's top edge, in pixels.
    int width;
    int height;
    int advance;   // Distance from this glyph's pen to the next glyph's pen, in pixels.
    uint8_t *mask; // Coverage, packed rows; NULL if the glyph shows nothing.
} Glyph;

struct DipFont {
    FT_Library library;
    FT_Face face;
    int face_size; // The size to which the face is set; 0 before the first size is set.
    int ascent[DIP_FONT_MAX_SIZE + 1];
    int line_height[DIP_FONT_MAX_SIZE + 1]; // 0 if it is not computed yet.
    Glyph glyphs[GLYPH_SLOTS];
    int glyph_count;
};

// --- the face ----------------------------------------------------------------------------------

// Fills in the file of the system's sans-serif font and the face's index in that file.
static bool find_font(char *file, size_t size_bytes, int *index) {
    FcConfig *config = FcInitLoadConfigAndFonts();
    FcPattern *wanted = FcNameParse((const FcChar8 *)"sans:scalable=true");
    FcPattern *found = NULL;
    FcResult result = FcResultNoMatch;
    FcChar8 *name = NULL;
    if (config && wanted) {
        FcConfigSubstitute(config, wanted, FcMatchPattern);
        FcDefaultSubstitute(wanted);
        found = FcFontMatch(config, wanted, &result);
    }
    bool ok = found && FcPatternGetString(found, FC_FILE, 0, &name) == FcResultMatch;
    if (ok) {
        const int length = snprintf(file, size_bytes, "%s", (const char *)name);
        FcPatternGetInteger(found, FC_INDEX, 0, index);
        ok = length > 0 && (size_t)length < size_bytes;
    }
    if (found) {
        FcPatternDestroy(found);
    }
    if (wanted) {
        FcPatternDestroy(wanted);
    }
    if (config) {
        FcConfigDestroy(config);
    }
    return ok;
}

static bool open_face(DipFont *font) {
    char file[1024];
    int index = 0;
    return FT_Init_FreeType(&font->library) == 0 && find_font(file, sizeof file, &index) &&
           FT_New_Face(font->library, file, index, &font->face) == 0 &&
           FT_IS_SCALABLE(font->face) != 0;
}

DipFont *dip_font_create(DipError *err) {
    DipFont *font = calloc(1, sizeof *font);
    if (!font) {
        dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "font", "out of memory");
        return NULL;
    }
    if (!open_face(font)) {
        dip_error_set_runtime(err, DIP_ERROR_MISSING, NULL, 0, "font",
                              "no sans-serif font was found; install one, such as Debian's "
                              "fonts-dejavu-core");
        dip_font_destroy(&font);
    }
    return font;
}

static void forget_glyphs(DipFont *font) {
    for (int i = 0; i < GLYPH_SLOTS; ++i) {
        free(font->glyphs[i].mask);
        font->glyphs[i] = (Glyph){0};
    }
    font->glyph_count = 0;
}

void dip_font_destroy(DipFont **font_pointer) {
    DipFont *font = *font_pointer;
    if (!font) {
        return;
    }
    *font_pointer = NULL;
    forget_glyphs(font);
    if (font->face) {
        FT_Done_Face(font->face);
    }
    if (font->library) {
        FT_Done_FreeType(font->library);
    }
    free(font);
}

static int clamp_size(int size) {
    return size < DIP_FONT_MIN_SIZE   ? DIP_FONT_MIN_SIZE
           : size > DIP_FONT_MAX_SIZE ? DIP_FONT_MAX_SIZE
                                      : size;
}

// Converts a FreeType length, in 1/64 pixel, to whole pixels, rounded up.
static int pixels_up(FT_Pos position) {
    return (int)((position + 63) >> 6);
}

static void set_face_size(DipFont *font, int size) {
    if (font->face_size == size) {
        return;
    }
    font->face_size = size;
    FT_Set_Pixel_Sizes(font->face, 0, (FT_UInt)size);
    const FT_Fixed scale = font->face->size->metrics.y_scale;
    font->ascent[size] = pixels_up(FT_MulFix(font->face->ascender, scale));
    // Rounding moves the baseline down, so letters may need one row more than the face's height.
    const int height = pixels_up(FT_MulFix(font->face->height, scale));
    const int letters = font->ascent[size] + pixels_up(FT_MulFix(-font->face->descender, scale));
    font->line_height[size] = letters > height ? letters : height;
}

int dip_font_line_height(DipFont *font, int size) {
    size = clamp_size(size);
    if (font->line_height[size] == 0) {
        set_face_size(font, size);
    }
    return font->line_height[size];
}

// --- glyphs ------------------------------------------------------------------------------------

// Fills an empty glyph. If memory runs out for its mask, the glyph is a gap of the same width, and
// the function returns false.
static bool draw_glyph(DipFont *font, int size, uint32_t code_point, Glyph *glyph) {
    set_face_size(font, size);
    if (FT_Load_Char(font->face, code_point, FT_LOAD_RENDER | FT_LOAD_TARGET_NORMAL) != 0) {
        glyph->advance = size / 2;
        return true;
    }
    const FT_GlyphSlot slot = font->face->glyph;
    const FT_Bitmap *bitmap = &slot->bitmap;
    const size_t width = bitmap->width, height = bitmap->rows;
    glyph->advance = pixels_up(slot->advance.x - 32);
    if (width == 0 || height == 0 || bitmap->pixel_mode != FT_PIXEL_MODE_GRAY) {
        return true;
    }
    glyph->mask = malloc(width * height);
    if (!glyph->mask) {
        return false;
    }
    for (size_t y = 0; y < height; ++y) {
        memcpy(glyph->mask + y * width, bitmap->buffer + (ptrdiff_t)y * bitmap->pitch, width);
    }
    glyph->left = slot->bitmap_left;
    glyph->top = slot->bitmap_top;
    glyph->width = (int)width;
    glyph->height = (int)height;
    return true;
}

static const Glyph *find_glyph(DipFont *font, int size, uint32_t code_point) {
    const uint32_t key = (uint32_t)size << 21 | code_point; // Code points have 21 bits.
    uint32_t slot = (key * 2654435761u) >> 20;              // Knuth's multiplicative hash, 12 bits.
    while (font->glyphs[slot].key != key && font->glyphs[slot].key != 0) {
        slot = (slot + 1) % GLYPH_SLOTS;
    }
    Glyph *glyph = &font->glyphs[slot];
    if (glyph->key == key) {
        return glyph;
    }
    if (font->glyph_count >= MAX_GLYPHS) {
        forget_glyphs(font);
        return find_glyph(font, size, code_point);
    }
    // If there is no memory for the mask, the slot stays empty, so that the glyph is drawn anew
    // next time.
    *glyph = (Glyph){0};
    if (draw_glyph(font, size, code_point, glyph)) {
        ++font->glyph_count;
        glyph->key = key;
    }
    return glyph;
}

// --- lines -------------------------------------------------------------------------------------

// Reads one character and moves *line behind it. Invalid bytes are read one at a time.
static uint32_t next_code_point(const char **line) {
    uint32_t code_point = replacement_character;
    const size_t length = dip_utf8_read(*line, DIP_UTF8_MOST_BYTES, &code_point);
    *line += length > 0 ? length : 1;
    return code_point;
}

int dip_font_width(DipFont *font, int size, const char *line) {
    int width = 0;
    size = clamp_size(size);
    while (*line) {
        width += find_glyph(font, size, next_code_point(&line))->advance;
    }
    return width;
}

// Returns how many bytes of the line fit into `room`, the width that an ellipsis leaves free; -1 if
// not even the ellipsis fits.
static ptrdiff_t fitting_bytes(DipFont *font, int size, int room, const char *line) {
    const char *at = line;
    ptrdiff_t bytes = room >= 0 ? 0 : -1;
    int width = 0;
    while (*at && bytes >= 0) {
        width += find_glyph(font, size, next_code_point(&at))->advance;
        if (width > room) {
            break;
        }
        bytes = at - line;
    }
    return bytes;
}

void dip_font_fit(DipFont *font, int size, int max_width, char *line, size_t size_bytes) {
    size = clamp_size(size);
    if (dip_font_width(font, size, line) <= max_width) {
        return;
    }
    const int room = max_width - dip_font_width(font, size, ellipsis);
    ptrdiff_t bytes = fitting_bytes(font, size, room, line);
    while (bytes > 0 && line[bytes - 1] == ' ') {
        --bytes;
    }
    if (bytes < 0 || (size_t)bytes + sizeof ellipsis > size_bytes) {
        line[0] = '\0';
    } else {
        memcpy(line + bytes, ellipsis, sizeof ellipsis);
    }
}

void dip_font_draw(DipFont *font, DipCanvas *canvas, int size, DipColour colour, int x, int y,
                   const char *line) {
    size = clamp_size(size);
    if (font->line_height[size] == 0) {
        set_face_size(font, size);
    }
    const int baseline = y + font->ascent[size];
    while (*line) {
        const Glyph *glyph = find_glyph(font, size, next_code_point(&line));
        if (glyph->mask) {
            dip_canvas_mask(canvas, x + glyph->left, baseline - glyph->top, glyph->width,
                            glyph->height, glyph->mask, colour);
        }
        x += glyph->advance;
    }
}
