// Writes the options that name a scene as words of a command line.
#include "app/preview/state/scene_words.h"

#include <stdio.h>
#include <string.h>

// Writes a value as one word of a shell. Returns false if it does not fit.
static bool quote(const char *value, char word[DIP_SCENE_WORDS_BYTES]) {
    static const char plain[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789"
                                "_-./,=:+%@";
    if (value[0] && !value[strspn(value, plain)]) {
        return snprintf(word, DIP_SCENE_WORDS_BYTES, "%s", value) < DIP_SCENE_WORDS_BYTES;
    }
    size_t length = 0;
    word[length++] = '\'';
    for (; *value; ++value) {
        if (length + 6 > DIP_SCENE_WORDS_BYTES) { // Room for an escaped quote, a quote and the 0.
            return false;
        }
        if (*value == '\'') { // Ends the quotes, adds an escaped quote and opens them again.
            memcpy(word + length, "'\\'", 3);
            length += 3;
        }
        word[length++] = *value;
    }
    word[length++] = '\'';
    word[length] = '\0';
    return true;
}

// Appends an option and its value, or " ..." if they do not fit. A NULL value appends nothing.
static void add_option(char text[DIP_SCENE_WORDS_BYTES], const char *option, const char *value) {
    static const char cut[] = " ...";
    char word[DIP_SCENE_WORDS_BYTES];
    if (!value) {
        return;
    }
    const size_t start = strlen(text), room = DIP_SCENE_WORDS_BYTES - start;
    const bool quoted = quote(value, word);
    const int length = quoted ? snprintf(text + start, room, " %s %s", option, word) : 0;
    if (!quoted || (size_t)length + sizeof cut > room) {
        snprintf(text + start, room, "%s", cut);
    }
}

static void add_models(const DipSessionOptions *options, char text[DIP_SCENE_WORDS_BYTES]) {
    char time_s[32];
    for (int i = 0; i < options->model_count; ++i) {
        add_option(text, "--model", options->models[i]);
    }
    add_option(text, "--up", options->up ? dip_up_axis_names[options->up] : NULL);
    add_option(text, "--shading",
               options->has_shading ? dip_model_shading_names[options->shading] : NULL);
    if (options->no_ground) {
        strncat(text, " --no-ground", DIP_SCENE_WORDS_BYTES - strlen(text) - 1);
    }
    add_option(text, "--animation", options->animation);
    snprintf(time_s, sizeof time_s, "%.17g", options->animation_time_s);
    add_option(text, "--animation-time", options->has_animation_time ? time_s : NULL);
}

void dip_scene_words(const DipSessionOptions *options, int look, char text[DIP_SCENE_WORDS_BYTES]) {
    char number[32], size[32];
    text[0] = '\0';
    if (!options) {
        return;
    }
    add_option(text, "--config", options->config);
    add_models(options, text);
    add_option(text, "--scene", options->scene);
    snprintf(number, sizeof number, "%d", look + 1);
    add_option(text, "--look", look > 0 ? number : NULL);
    add_option(text, "--path", options->path);
    snprintf(size, sizeof size, "%dx%d", options->size.width, options->size.height);
    add_option(text, "--size", options->has_size ? size : NULL);
}
