// Opens sessions on a thread: from files that were dropped or have changed, or with another
// animation.
#include "app/preview/loop/reload.h"

#include "app/cost/plan.h"
#include "app/cli/log.h"
#include "app/files/put.h"
#include "app/files/whole_file.h"
#include "app/preview/loop/watch.h"
#include "renderer/base/clock.h"

#include <pthread.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>

enum { MAX_DROPS = 64 };

// A session that is being opened on a thread, and the result. While the thread is running, the main
// thread reads only `running` and `done`.
typedef struct Opening {
    pthread_t thread;
    bool running;
    atomic_bool done;
    const char *file;               // The dropped file; NULL if none was dropped.
    bool animated;                  // The session is opened because another animation was chosen.
    char name[DIP_WATCH_NAME_SIZE]; // Name, without folder, of the dropped or changed file, or of
                                    // the chosen animation.
    DipSessionOptions options;
    const DipImporter *importer;
    DipSession session;
    DipErrorList faults;
    bool opened;
} Opening;

struct DipReload {
    DipSession *session;
    const DipSessionOptions *first_options; // Options of the session before the first reload.
    DipSessionOptions options;              // Options of the session that the preview shows.
    DipWatch *watch;                        // NULL without --watch.
    bool changed; // A file has changed, so the session must be opened again.
    char changed_name[DIP_WATCH_NAME_SIZE];
    const char *animation;        // Animation that waits to be opened, or NULL.
    const char *drops[MAX_DROPS]; // Dropped files to be opened, the oldest first.
    int drop_count;
    const char *passed; // The dropped file that was tried last, if another one waited behind it;
                        // otherwise NULL.
    bool passed_failed; // `passed` could not be opened.
    // Names of all files dropped and animations chosen so far, each once; options point to them.
    char **names;
    int name_count;
    Opening opening;
    DipCostReport *costs; // The report that was dropped last. Owned; NULL if none was opened.
};

// --- the files of a session ----------------------------------------------------------------------

static void watch_model(DipWatch *watch, const char *file) {
    dip_watch_file(watch, file);
    dip_watch_folder(watch, file);
}

static void watch_config(DipWatch *watch, const DipConfig *config) {
    dip_watch_file(watch, config->file);
    for (size_t i = 0; i < config->xfile.count; ++i) {
        watch_model(watch, config->xfile.items[i].path);
    }
    for (int c = 0; c < DIP_CATEGORY_COUNT; ++c) {
        if (config->camera[c].file.path) {
            dip_watch_file(watch, config->camera[c].file.path);
        }
    }
    for (int m = 0; m < DIP_MIP_LEVEL_COUNT; ++m) {
        if (config->mip_picture[m].path) {
            dip_watch_file(watch, config->mip_picture[m].path);
        }
    }
}

// Watches the files of the session. Also watches the files in which the last opening of a session
// has found faults, because the user is about to mend them.
static void watch_session(DipReload *reload, const DipErrorList *faults) {
    const DipSessionOptions *options = &reload->options;
    if (!reload->watch) {
        return;
    }
    dip_watch_begin_list(reload->watch);
    if (reload->session->config.file) {
        watch_config(reload->watch, &reload->session->config);
    }
    for (int i = 0; i < options->model_count; ++i) {
        watch_model(reload->watch, options->models[i]);
    }
    if (options->path) {
        dip_watch_file(reload->watch, options->path);
    }
    for (size_t i = 0; i < faults->count; ++i) {
        if (faults->items[i].file[0]) {
            dip_watch_file(reload->watch, faults->items[i].file);
        }
    }
    dip_watch_end_list(reload->watch);
}

// --- creating and destroying ---------------------------------------------------------------------

DipReload *dip_reload_create(DipSession *session, bool watch, DipError *err) {
    DipReload *reload = calloc(1, sizeof *reload);
    if (!reload || (watch && !(reload->watch = dip_watch_create()))) {
        free(reload);
        dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "preview", "out of memory");
        return NULL;
    }
    reload->session = session;
    reload->first_options = session->options;
    reload->options = *session->options;
    watch_session(reload, &(DipErrorList){0});
    return reload;
}

static void join(Opening *opening) {
    if (opening->running) {
        pthread_join(opening->thread, NULL);
        opening->running = false;
    }
}

static void drop_opening(Opening *opening) {
    if (opening->opened) {
        dip_session_close(&opening->session);
        opening->opened = false;
    }
    dip_error_list_free(&opening->faults);
}

void dip_reload_destroy(DipReload **reload_pointer) {
    DipReload *reload = *reload_pointer;
    if (!reload) {
        return;
    }
    *reload_pointer = NULL;
    join(&reload->opening);
    drop_opening(&reload->opening);
    reload->session->options = reload->first_options;
    dip_watch_destroy(&reload->watch);
    for (int i = 0; i < reload->name_count; ++i) {
        free(reload->names[i]);
    }
    free(reload->names);
    dip_costs_free(&reload->costs);
    free(reload);
}

// --- dropped files -------------------------------------------------------------------------------

// Returns a copy of a name. The copy lives as long as the reload. Returns NULL when memory runs
// out.
static const char *keep_name(DipReload *reload, const char *file) {
    for (int i = 0; i < reload->name_count; ++i) {
        if (strcmp(reload->names[i], file) == 0) {
            return reload->names[i];
        }
    }
    char **grown = realloc(reload->names, ((size_t)reload->name_count + 1) * sizeof *grown);
    if (!grown) {
        return NULL;
    }
    reload->names = grown;
    char *name = strdup(file);
    if (name) {
        reload->names[reload->name_count++] = name;
    }
    return name;
}

bool dip_reload_drop(DipReload *reload, const char *file) {
    const char *name = reload->drop_count < MAX_DROPS ? keep_name(reload, file) : NULL;
    if (name) {
        reload->drops[reload->drop_count++] = name;
    }
    return name != NULL;
}

bool dip_reload_animate(DipReload *reload, const char *animation) {
    const char *name = keep_name(reload, animation);
    reload->animation = name ? name : reload->animation;
    return name != NULL;
}

static bool ends_with(const char *file, const char *ending) {
    const size_t length = strlen(file);
    const size_t tail = strlen(ending);
    return length >= tail && strcasecmp(file + length - tail, ending) == 0;
}

static bool is_path(const char *file) {
    return ends_with(file, ".pth") || ends_with(file, ".bth");
}

// Changes the options as if the command line named the file.
static void aim(DipSessionOptions *options, const char *file) {
    options->category = NULL;
    options->has_pose = false;
    options->path = NULL;
    if (is_path(file)) {
        options->path = file;
        return;
    }
    options->scene = NULL;
    options->look = 0;
    options->animation = NULL; // Other models have other animations.
    options->has_animation_time = false;
    options->model_count = 0;
    if (ends_with(file, ".ini")) {
        options->config = file;
        options->has_current = options->has_requested = false;
    } else {
        options->models[options->model_count++] = file;
    }
}

// --- opening -------------------------------------------------------------------------------------

static void *open_session(void *context) {
    Opening *opening = context;
    const DipSessionDef def = {
        .options = &opening->options,
        .importer = opening->importer,
        .log = "", // Unlike NULL, this keeps the open log.
        .scene = true,
        .renderers = true,
        .begin_ns = dip_clock_ns(),
    };
    opening->opened = dip_session_open(&opening->session, &def, &opening->faults);
    atomic_store(&opening->done, true);
    return NULL;
}

static bool tell(DipReloadNews *news, DipReloadKind kind, const char *what, const char *name) {
    news->kind = kind;
    snprintf(news->notice, sizeof news->notice, "%s%.100s", what, name);
    return true;
}

static bool tell_fault(DipReloadNews *news, const DipErrorList *faults) {
    news->kind = DIP_RELOAD_FAULT;
    snprintf(news->notice, sizeof news->notice, "out of memory");
    for (size_t i = 0; i < faults->count; ++i) {
        if (faults->items[i].severity == DIP_SEVERITY_ERROR || faults->error_count == 0) {
            dip_preview_error_text(&faults->items[i], news->notice);
            break;
        }
    }
    return true;
}

// Turns an error into news and writes it to the log. Returns true.
static bool tell_error(DipReloadNews *news, const DipError *err) {
    DipErrorList faults = {0};
    dip_error_list_add(&faults, err);
    dip_log_errors(&faults);
    tell_fault(news, &faults);
    dip_error_list_free(&faults);
    return true;
}

// Returns whether the name belongs to a folder, a named pipe or a device. The command line may name
// a pipe as its ini, but a pipe cannot be opened again: it can be read only once, and waiting for
// its writer could take for ever.
static bool is_no_file(const char *file) {
    struct stat status;
    return file && stat(file, &status) == 0 && !S_ISREG(status.st_mode);
}

// Begins to open the dropped `file`. If `file` is NULL, begins to open the files of the present
// session again, with the animation that waits, if there is one. `name` is the name for notices.
static bool begin(DipReload *reload, const char *file, const char *name, DipReloadNews *news) {
    Opening *opening = &reload->opening;
    opening->options = reload->options;
    opening->importer = reload->session->importer;
    opening->file = file;
    opening->animated = !file && reload->animation;
    opening->opened = false;
    snprintf(opening->name, sizeof opening->name, "%.255s", name);
    if (file) {
        aim(&opening->options, file);
    } else if (reload->animation) {
        opening->options.animation = reload->animation;
        reload->animation = NULL;
    }
    news->dropped = file != NULL;
    news->animated = opening->animated;
    if (is_no_file(opening->options.config)) {
        DipError err;
        dip_error_set(&err, DIP_ERROR_IO, opening->options.config, 0, NULL,
                      "is not a file, accepted an ini file");
        return tell_error(news, &err);
    }
    atomic_store(&opening->done, false);
    opening->running = pthread_create(&opening->thread, NULL, open_session, opening) == 0;
    return opening->running ? tell(news, DIP_RELOAD_BEGUN, "Opening ", opening->name)
                            : tell(news, DIP_RELOAD_FAULT, "No thread could start for ", name);
}

// Returns whether a fault says that a picture is missing (assets/model.h).
static bool is_missing_picture(const DipError *fault) {
    return fault->severity == DIP_SEVERITY_WARNING && fault->code == DIP_ERROR_MISSING;
}

static bool names_file(const DipError *fault, const char *name) {
    return strstr(fault->message, name) || strstr(fault->file, name);
}

// Returns whether a file that has changed, or has disappeared, was left out of the new session. An
// unreadable picture is such a file: the session opens with a warning, but lacks its texture.
static bool lacks_changed_file(const Opening *opening) {
    const char *name = opening->name; // Empty if the file has disappeared.
    const bool changed = !opening->file && !opening->animated;
    for (size_t i = 0; changed && i < opening->faults.count; ++i) {
        const DipError *fault = &opening->faults.items[i];
        if (name[0] ? names_file(fault, name) : is_missing_picture(fault)) {
            return true;
        }
    }
    return false;
}

// Adds to the notice how many pictures are missing, and the first of the other warnings.
static void tell_warnings(DipReloadNews *news, const DipErrorList *faults) {
    const DipError *first = NULL;
    int pictures = 0;
    for (size_t i = faults->count; i-- > 0;) {
        const DipError *fault = &faults->items[i];
        const bool missing = is_missing_picture(fault);
        pictures += missing;
        first = missing ? first : fault;
    }
    const int others = (int)faults->count - pictures;
    news->warns = faults->count > 0;
    if (pictures > 0) {
        dip_put_append(news->notice, sizeof news->notice, ", %d picture%s missing", pictures,
                       pictures > 1 ? "s" : "");
    }
    if (others > 1) {
        dip_put_append(news->notice, sizeof news->notice, ", with %d warnings: %s", others,
                       first->message);
    } else if (others > 0) {
        dip_put_append(news->notice, sizeof news->notice, ", with a warning: %s", first->message);
    }
}

// Adds to the notice what became of the file that was dropped just before the file that is open
// now.
static void tell_passed(const DipReload *reload, DipReloadNews *news) {
    const char *passed = reload->opening.file ? reload->passed : NULL;
    if (passed && reload->passed_failed) {
        dip_put_append(news->notice, sizeof news->notice, "; %.60s could not be opened",
                       dip_base_name(passed));
    } else if (passed && (is_path(passed) || !is_path(reload->opening.file))) {
        dip_put_append(news->notice, sizeof news->notice, " in place of %.60s",
                       dip_base_name(passed));
    }
}

// Joins the thread that opened a session, and turns the result into news. Returns true.
static bool finish(DipReload *reload, DipReloadNews *news) {
    Opening *opening = &reload->opening;
    join(opening);
    dip_log_errors(&opening->faults);
    news->dropped = opening->file != NULL;
    news->animated = opening->animated && !reload->animation;
    const bool good = opening->opened && !lacks_changed_file(opening);
    if (good) {
        tell(news, DIP_RELOAD_SESSION,
             opening->animated ? "Animation: "
             : opening->file   ? "Opened "
                               : "Reloaded ",
             opening->name[0] ? opening->name : "the scene");
        tell_passed(reload, news);
        if (!opening->animated) {
            tell_warnings(news, &opening->faults);
        }
    } else {
        tell_fault(news, &opening->faults);
        watch_session(reload, &opening->faults);
        drop_opening(opening);
    }
    reload->passed = opening->file && reload->drop_count > 0 ? opening->file : NULL;
    reload->passed_failed = !good;
    return true;
}

void dip_reload_take(DipReload *reload) {
    Opening *opening = &reload->opening;
    const DipStartTimes times = reload->session->times;
    dip_session_close(reload->session);
    *reload->session = opening->session;
    opening->opened = false;
    reload->options = opening->options;
    reload->session->options = &reload->options;
    reload->session->times = times; // Keeps the times of the program's start, which --timing
                                    // reports.
    watch_session(reload, &opening->faults);
    dip_error_list_free(&opening->faults);
}

// --- cost reports --------------------------------------------------------------------------------

static bool open_costs(DipReload *reload, DipPrices *prices, const char *file,
                       DipReloadNews *news) {
    char scene[DIP_COST_TEXT];
    DipError err;
    dip_cost_scene_name(reload->session, scene);
    reload->passed = NULL;
    news->dropped = true;
    DipCostReport *costs = dip_costs_load(prices, file, scene, &err);
    if (!costs) {
        return tell_error(news, &err);
    }
    dip_costs_free(&reload->costs);
    news->costs = reload->costs = costs;
    return tell(news, DIP_RELOAD_COSTS, "Opened ", dip_base_name(file));
}

// --- turns ---------------------------------------------------------------------------------------

static bool open_next_drop(DipReload *reload, DipPrices *prices, DipReloadNews *news) {
    const char *file = reload->drops[0];
    --reload->drop_count;
    memmove(reload->drops, reload->drops + 1, (size_t)reload->drop_count * sizeof file);
    return ends_with(file, ".json") ? open_costs(reload, prices, file, news)
                                    : begin(reload, file, dip_base_name(file), news);
}

bool dip_reload_poll(DipReload *reload, DipPrices *prices, int64_t now_ns, DipReloadNews *news) {
    *news = (DipReloadNews){.kind = DIP_RELOAD_NOTHING};
    if (reload->watch && dip_watch_poll(reload->watch, now_ns, reload->changed_name)) {
        reload->changed = true;
    }
    if (reload->opening.running) {
        return atomic_load(&reload->opening.done) && finish(reload, news);
    }
    if (reload->drop_count > 0) {
        return open_next_drop(reload, prices, news);
    }
    if (reload->changed || reload->animation) {
        reload->changed = false;
        return begin(reload, NULL, reload->animation ? reload->animation : reload->changed_name,
                     news);
    }
    return false;
}
