// The command `diptych preview`: its help, and the session that it opens.
#include "app/preview/command.h"

#include "app/preview/options.h"
#include "app/preview/preview.h"
#include "renderer/base/assert.h"

static bool run(DipSession *session, const void *options, DipError *err) {
    return dip_preview_run(session, options, err);
}

static void describe_session(const void *options, DipSessionDef *def) {
    const DipPreviewOptions *preview = options;
    def->options = &preview->session;
    def->scene = true;
    def->renderers = true;
}

static const DipExample examples[] = {
    {"diptych", "opens the courtyard with the ini's settings"},
    {"diptych --current aa=none --requested aa=8,af=16", "compares two settings side by side"},
    {"diptych model.glb", "orbits a model of yours"},
    {"diptych --scene tour", "shows the scenes of the gallery, 15 seconds each"},
    {"diptych --window-id 0x2800003 --control -", "shows inside a window of another program"},
    {"diptych --config my.ini --watch", "shows each change of the ini or a texture at once"},
    {"diptych --cost report/cost.json", "also shows what `diptych cost` measured"},
};

const DipCommand dip_preview_command = {
    .name = "preview",
    .summary = "open the window: two panes, one camera path (the default)",
    .usage = "[OPTION]... [MODEL]...",
    .text = "Preview opens a window with two panes. Both show the same camera path, the left one "
            "with the current settings and the right one with the requested settings. Keys change "
            "the requested settings while the camera moves; F1 lists the keys.\n\n"
            "A game controller works, too: the sticks and triggers fly the camera, Y frees it, the "
            "shoulder buttons and the directional pad choose and change settings, A presses, X "
            "applies, B undoes, Start pauses, and Back leaves.\n\n"
            "Dragging in a pane with the right mouse button frees the camera from its path and "
            "turns it, or orbits a model. The keys W, A, S, D, Q and E move it, the wheel changes "
            "its speed or its distance, Home takes it back, and C lets it follow its path again. "
            "The tab Path (Ctrl+P) makes a camera path from its poses and saves it to a new "
            ".pth file.\n\n"
            "A model, a camera path, an ini or a cost report that is dropped onto the window takes "
            "the place of what it shows. If the file is bad, the window says so and stays as it "
            "is.",
    .examples = examples,
    .example_count = DIP_ARRAY_COUNT(examples),
    .lists_settings = true,
    .parts = &dip_preview_option_parts,
    .operands = {offsetof(DipPreviewOptions, session.models),
                 offsetof(DipPreviewOptions, session.model_count), DIP_MAX_MODELS},
    .options_size = sizeof(DipPreviewOptions),
    .check = dip_preview_options_check,
    .describe_session = describe_session,
    .run = run,
};
