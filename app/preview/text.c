// Text through SDL_ttf.
#include "app/preview/text.h"

#include <SDL2/SDL_ttf.h>
#include <fontconfig/fontconfig.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_LINE_BYTES = 256 };

struct DipText {
    SDL_Renderer *renderer;
    char file[1024];
    int face; // index in the file
    TTF_Font *fonts[DIP_TEXT_MAX_SIZE + 1];
    bool library_open;
};

static bool find_font(DipText *text) {
    FcConfig *config = FcInitLoadConfigAndFonts();
    FcPattern *wanted = FcNameParse((const FcChar8 *)"sans:scalable=true");
    FcPattern *found = NULL;
    bool ok = false;
    if (config && wanted) {
        FcResult result = FcResultNoMatch;
        FcChar8 *file = NULL;
        FcConfigSubstitute(config, wanted, FcMatchPattern);
        FcDefaultSubstitute(wanted);
        found = FcFontMatch(config, wanted, &result);
        if (found && FcPatternGetString(found, FC_FILE, 0, &file) == FcResultMatch) {
            const int length = snprintf(text->file, sizeof text->file, "%s", (const char *)file);
            FcPatternGetInteger(found, FC_INDEX, 0, &text->face);
            ok = length > 0 && (size_t)length < sizeof text->file;
        }
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

static int clamp_size(int size) {
    return size < DIP_TEXT_MIN_SIZE   ? DIP_TEXT_MIN_SIZE
           : size > DIP_TEXT_MAX_SIZE ? DIP_TEXT_MAX_SIZE
                                      : size;
}

static TTF_Font *font_of(DipText *text, int size) {
    TTF_Font **font = &text->fonts[clamp_size(size)];
    if (!*font) {
        *font = TTF_OpenFontIndex(text->file, clamp_size(size), text->face);
    }
    return *font;
}

DipText *dip_text_create(SDL_Renderer *renderer, DipError *err) {
    DipText *text = calloc(1, sizeof *text);
    if (!text) {
        dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "font", "out of memory");
        return NULL;
    }
    text->renderer = renderer;
    text->library_open = TTF_Init() == 0;
    if (!text->library_open) {
        dip_error_set(err, DIP_ERROR_RUNTIME, NULL, 0, "font", "%s", TTF_GetError());
    } else if (!find_font(text) || !font_of(text, DIP_TEXT_MIN_SIZE)) {
        dip_error_set_runtime(err, DIP_ERROR_MISSING, NULL, 0, "font",
                              "no sans-serif font was found, install one, such as Debian's "
                              "fonts-dejavu-core");
    } else {
        return text;
    }
    dip_text_destroy(&text);
    return NULL;
}

void dip_text_destroy(DipText **text_pointer) {
    DipText *text = *text_pointer;
    if (!text) {
        return;
    }
    *text_pointer = NULL;
    for (int size = 0; size <= DIP_TEXT_MAX_SIZE; ++size) {
        if (text->fonts[size]) {
            TTF_CloseFont(text->fonts[size]);
        }
    }
    if (text->library_open) {
        TTF_Quit();
    }
    free(text);
}

int dip_text_line_height(DipText *text, int size) {
    TTF_Font *font = font_of(text, size);
    return font ? TTF_FontLineSkip(font) : size;
}

int dip_text_width(DipText *text, int size, const char *line) {
    TTF_Font *font = font_of(text, size);
    int width = 0;
    if (font && TTF_SizeUTF8(font, line, &width, NULL) != 0) {
        width = 0;
    }
    return width;
}

// Cuts whole characters off the end until the line and an ellipsis fit.
static void fit(DipText *text, int size, int max_width, char line[MAX_LINE_BYTES]) {
    static const char ellipsis[] = "\xe2\x80\xa6";
    size_t length = strlen(line);
    if (dip_text_width(text, size, line) <= max_width) {
        return;
    }
    if (length > MAX_LINE_BYTES - sizeof ellipsis) {
        length = MAX_LINE_BYTES - sizeof ellipsis;
    }
    while (length > 0) {
        do {
            --length;
        } while (length > 0 && ((unsigned char)line[length] & 0xc0) == 0x80);
        strcpy(line + length, ellipsis);
        if (dip_text_width(text, size, line) <= max_width) {
            return;
        }
    }
    line[0] = '\0';
}

void dip_text_draw(DipText *text, int size, SDL_Color colour, DipAlign align, int x, int y,
                   int max_width, const char *line) {
    char fitting[MAX_LINE_BYTES];
    snprintf(fitting, sizeof fitting, "%s", line);
    fit(text, size, max_width, fitting);
    TTF_Font *font = font_of(text, size);
    SDL_Surface *surface =
        font && fitting[0] ? TTF_RenderUTF8_Blended(font, fitting, colour) : NULL;
    SDL_Texture *texture = surface ? SDL_CreateTextureFromSurface(text->renderer, surface) : NULL;
    if (texture) {
        const int shift = align == DIP_ALIGN_RIGHT    ? surface->w
                          : align == DIP_ALIGN_CENTRE ? surface->w / 2
                                                      : 0;
        const SDL_Rect to = {x - shift, y, surface->w, surface->h};
        SDL_RenderCopy(text->renderer, texture, NULL, &to);
        SDL_DestroyTexture(texture);
    }
    SDL_FreeSurface(surface);
}
