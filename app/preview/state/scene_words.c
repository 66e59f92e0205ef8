// Writes the options that name a scene as words of a command line.
#include "app/preview/state/scene_words.h"

#include <stdio.h>
#include <string.h>

// Appends a character. Leaves the text whole if there is no more room.
static bool add_letter(char text[DIP_SCENE_WORDS_BYTES], size_t *length, char letter) {
    if (*length + 1 >= DIP_SCENE_WORDS_BYTES) {
        return false;
    }
    text[(*length)++] = letter;
    text[*length] = '\0';
    return true;
}

// Appends a value as one word of a shell.
static bool add_word(char text[DIP_SCENE_WORDS_BYTES], size_t *length, const char *value) {
    static const char plain[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789"
                                "_-./,=:+%@";
    const bool quoted = value[0] == '\0' || value[strspn(value, plain)] != '\0';
    bool fits = !quoted || add_letter(text, length, '\'');
    for (const char *letter = value; *letter && fits; ++letter) {
        if (*letter == '\'') { // Ends the quotes, adds an escaped quote and opens them again.
            fits = add_letter(text, length, '\'') && add_letter(text, length, '\\') &&
                   add_letter(text, length, '\'');
        }
        fits = fits && add_letter(text, length, *letter);
    }
    return fits && (!quoted || add_letter(text, length, '\''));
}

// Appends an option and its value, or " ..." if they do not fit.
static void add_option(char text[DIP_SCENE_WORDS_BYTES], const char *option, const char *value) {
    static const char cut[] = " ...";
    const size_t start = strlen(text);
    size_t length = start;
    bool fits = add_letter(text, &length, ' ');
    for (const char *letter = option; *letter && fits; ++letter) {
        fits = add_letter(text, &length, *letter);
    }
    fits = fits && add_letter(text, &length, ' ') && add_word(text, &length, value) &&
           length + sizeof cut <= DIP_SCENE_WORDS_BYTES;
    if (!fits) {
        snprintf(text + start, DIP_SCENE_WORDS_BYTES - start, "%s", cut);
    }
}

void dip_scene_words(const DipSessionOptions *options, char text[DIP_SCENE_WORDS_BYTES]) {
    text[0] = '\0';
    if (!options) {
        return;
    }
    if (options->config) {
        add_option(text, "--config", options->config);
    }
    for (int i = 0; i < options->model_count; ++i) {
        add_option(text, "--model", options->models[i]);
    }
    if (options->scene) {
        add_option(text, "--scene", options->scene);
    }
    if (options->has_size) {
        char size[32];
        snprintf(size, sizeof size, "%dx%d", options->size.width, options->size.height);
        add_option(text, "--size", size);
    }
}
