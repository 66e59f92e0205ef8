// Edits the keys (poses) of the path that the user makes, flies the path and saves it.
#include "app/preview/state/path_editor.h"

#include "app/preview/state/poses.h"
#include "renderer/base/assert.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// The times from key to key among which the user chooses.
static const int64_t periods_ns[] = {100000000,  250000000,  500000000,  1000000000, 1500000000,
                                     2000000000, 3000000000, 5000000000, 10000000000};

DipPathEditor *dip_path_editor_create(DipError *err) {
    DipPathEditor *editor = calloc(1, sizeof *editor);
    if (!editor) {
        dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "path", "out of memory");
        return NULL;
    }
    editor->period_ns = INT64_C(1000000000);
    return editor;
}

void dip_path_editor_destroy(DipPathEditor **editor_pointer) {
    DipPathEditor *editor = *editor_pointer;
    if (editor) {
        *editor_pointer = NULL;
        dip_campath_destroy(&editor->fly);
        free(editor->keys);
        free(editor);
    }
}

void dip_path_editor_see(DipPathEditor *editor, const DipPose *pose) {
    memcpy(editor->seen.position_world, pose->position_world, sizeof pose->position_world);
    memcpy(editor->seen.orientation, pose->orientation, sizeof pose->orientation);
    editor->has_seen = true;
}

// --- keys ----------------------------------------------------------------------------------------

static bool reserve(DipPathEditor *editor, size_t count) {
    if (count <= editor->capacity) {
        return true;
    }
    const size_t capacity = count < 64 ? 64 : 2 * count;
    DipCamKey *keys = realloc(editor->keys, capacity * sizeof *keys);
    if (!keys) {
        return false;
    }
    editor->keys = keys;
    editor->capacity = capacity;
    return true;
}

// Notes what an edit did, or why it did nothing. Returns `done`.
__attribute__((format(printf, 3, 4))) static bool say(DipPathEditor *editor, bool done,
                                                      const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(editor->said, sizeof editor->said, format, arguments);
    va_end(arguments);
    return done;
}

static bool add(DipPathEditor *editor) {
    if (!editor->has_seen) {
        return say(editor, false, "The camera has no pose yet");
    }
    if (editor->count >= DIP_PATH_EDITOR_MAX_KEYS) {
        return say(editor, false, "The path has 10000 keys, and cannot have more");
    }
    if (!reserve(editor, editor->count + 1)) {
        return say(editor, false, "There is no memory for another key");
    }
    const size_t at = editor->count ? editor->chosen + 1 : 0;
    memmove(editor->keys + at + 1, editor->keys + at, (editor->count - at) * sizeof *editor->keys);
    editor->keys[at] = editor->seen;
    editor->chosen = at;
    editor->count++;
    editor->unsaved = true;
    return say(editor, true, "Added key %zu of %zu", at + 1, editor->count);
}

static bool replace(DipPathEditor *editor) {
    editor->keys[editor->chosen] = editor->seen;
    editor->unsaved = true;
    return say(editor, true, "Key %zu of %zu has the camera's pose now", editor->chosen + 1,
               editor->count);
}

static bool delete_chosen(DipPathEditor *editor) {
    const size_t at = editor->chosen;
    editor->count--;
    memmove(editor->keys + at, editor->keys + at + 1, (editor->count - at) * sizeof *editor->keys);
    editor->chosen = at > 0 ? at - 1 : 0;
    editor->unsaved = editor->count > 0;
    return say(editor, true, "Deleted key %zu; the path has %zu now", at + 1, editor->count);
}

void dip_path_editor_choose(DipPathEditor *editor, size_t index) {
    DIP_ASSERT(index < editor->count);
    dip_path_editor_stop(editor);
    editor->chosen = index;
    editor->jumps = true;
}

static bool choose_beside(DipPathEditor *editor, size_t by) {
    dip_path_editor_choose(editor, (editor->chosen + by) % editor->count);
    return say(editor, true, "Key %zu of %zu", editor->chosen + 1, editor->count);
}

static bool take(DipPathEditor *editor, const DipCamPath *playing) {
    if (!playing) {
        return say(editor, false, "There is no path");
    }
    const DipCamPathInfo info = dip_campath_info(playing);
    if (info.key_count > DIP_PATH_EDITOR_MAX_KEYS || !reserve(editor, info.key_count)) {
        return say(editor, false, "The path has too many keys to be edited");
    }
    for (size_t i = 0; i < info.key_count; ++i) {
        editor->keys[i] = dip_campath_key(playing, i);
    }
    editor->count = info.key_count;
    editor->chosen = 0;
    editor->period_ns = info.period_ns;
    editor->unsaved = false;
    return say(editor, true, "Took the %zu keys of the path", editor->count);
}

// Changes the time from key to key to the next longer or shorter one in periods_ns. A path that was
// taken over may have a time that lies between two of these.
static bool change_period(DipPathEditor *editor, bool longer) {
    const int count = (int)DIP_ARRAY_COUNT(periods_ns);
    int64_t found_ns = editor->period_ns;
    for (int i = 0; i < count && longer && found_ns == editor->period_ns; ++i) {
        found_ns = periods_ns[i] > editor->period_ns ? periods_ns[i] : found_ns;
    }
    for (int i = count - 1; i >= 0 && !longer && found_ns == editor->period_ns; --i) {
        found_ns = periods_ns[i] < editor->period_ns ? periods_ns[i] : found_ns;
    }
    editor->unsaved |= found_ns != editor->period_ns && editor->count > 0;
    editor->period_ns = found_ns;
    return say(editor, true, "%.3g s from key to key", 1e-9 * (double)found_ns);
}

// --- the whole path ------------------------------------------------------------------------------

static bool make_path(DipPathEditor *editor, DipCamPath **path) {
    DipError err;
    if (dip_campath_create(editor->keys, editor->count, editor->period_ns, path, &err)) {
        return true;
    }
    return say(editor, false, "%.150s", err.message);
}

static bool fly(DipPathEditor *editor, DipCamPathEnd end) {
    if (!make_path(editor, &editor->fly)) {
        return false;
    }
    const bool last = editor->chosen + 1 == editor->count;
    editor->end = end;
    editor->at_ns = last ? 0 : (int64_t)editor->chosen * editor->period_ns;
    return say(editor, true, "Flying the path from key %zu of %zu", last ? 1 : editor->chosen + 1,
               editor->count);
}

static bool save(DipPathEditor *editor) {
    DipCamPath *path;
    DipError err;
    char file[DIP_PATH_EDITOR_FILE_BYTES], what[64];
    if (!dip_saved_free_name("path", "pth", file, sizeof file)) {
        return say(editor, false, "No name from path-0001.pth to path-9999.pth is free");
    }
    if (!make_path(editor, &path)) {
        return false;
    }
    const bool saved = dip_campath_save_pth(path, file, &err);
    dip_campath_destroy(&path);
    if (!saved) {
        dip_error_format(&err, editor->said, sizeof editor->said);
        return false;
    }
    memcpy(editor->file, file, sizeof file);
    editor->unsaved = false;
    snprintf(what, sizeof what, "Saved %zu %s to", editor->count,
             editor->count == 1 ? "key" : "keys");
    dip_saved_describe(what, file, editor->said, sizeof editor->said);
    return true;
}

bool dip_path_editor_edit(DipPathEditor *editor, DipPathEdit edit, const DipCamPath *playing,
                          DipCamPathEnd end) {
    const bool flew = editor->fly != NULL;
    dip_path_editor_stop(editor);
    switch (edit) {
    case DIP_PATH_EDIT_ADD:
        return add(editor);
    case DIP_PATH_EDIT_TAKE:
        return take(editor, playing);
    case DIP_PATH_EDIT_SLOWER:
    case DIP_PATH_EDIT_FASTER:
        return change_period(editor, edit == DIP_PATH_EDIT_SLOWER);
    default:
        break;
    }
    if (editor->count == 0) {
        return say(editor, false, "The path has no key yet; Ctrl+N adds one");
    }
    switch (edit) {
    case DIP_PATH_EDIT_REPLACE:
        return replace(editor);
    case DIP_PATH_EDIT_DELETE:
        return delete_chosen(editor);
    case DIP_PATH_EDIT_NEXT:
        return choose_beside(editor, 1);
    case DIP_PATH_EDIT_BEFORE:
        return choose_beside(editor, editor->count - 1);
    case DIP_PATH_EDIT_FLY:
        return flew ? say(editor, true, "Stopped") : fly(editor, end);
    default:
        return save(editor);
    }
}

// --- what the preview's main loop calls ----------------------------------------------------------

void dip_path_editor_stop(DipPathEditor *editor) {
    dip_campath_destroy(&editor->fly);
    editor->jumps = false;
}

bool dip_path_editor_turn(DipPathEditor *editor, int64_t elapsed_ns, DipPose *pose) {
    if (editor->jumps && editor->count > 0) {
        const DipCamKey *key = &editor->keys[editor->chosen];
        memcpy(pose->position_world, key->position_world, sizeof key->position_world);
        memcpy(pose->orientation, key->orientation, sizeof key->orientation);
        editor->jumps = false;
        return true;
    }
    if (!editor->fly) {
        return false;
    }
    editor->at_ns += elapsed_ns;
    dip_campath_sample(editor->fly,
                       dip_campath_time_at_end(editor->fly, editor->end, editor->at_ns), pose);
    if (editor->end == DIP_CAMPATH_END_once &&
        editor->at_ns >= dip_campath_span_ns(editor->fly, editor->end)) {
        dip_path_editor_stop(editor);
    }
    return true;
}
