// Draws a window with the tools alone: no loop, no display.
#include "tests/app/preview/tool_window.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

static const DipColour ground = {20, 22, 26, 255};

static void make_session(DipToolWindow *tw, int width, int height) {
    tw->session = (DipSession){.pool = dip_pool_create(1, NULL), .isa = dip_isa_best()};
    tw->session.scene = dip_scene_create(&tw->scene.def, NULL, NULL);
    for (int p = 0; p < DIP_PANE_COUNT; ++p) {
        DipRendererDef def = dip_renderer_default_def();
        def.pool = tw->session.pool;
        def.width = width;
        def.height = height;
        tw->session.renderers[p] = dip_painter_create(&def, NULL, NULL);
        assert_non_null(tw->session.renderers[p]);
    }
    DipCamKey keys[2];
    for (int i = 0; i < 2; ++i) {
        memcpy(keys[i].position_world, tw->scene.pose.position_world,
               sizeof keys[i].position_world);
        memcpy(keys[i].orientation, tw->scene.pose.orientation, sizeof keys[i].orientation);
        keys[i].position_world[0] += i;
    }
    assert_true(dip_campath_create(keys, 2, INT64_C(5000000000), &tw->path, NULL));
    tw->session.track = dip_camtrack_make(true);
    dip_camtrack_set(&tw->session.track, 0, tw->path, 60.0);
}

static void make_layout(DipToolWindow *tw, int width, int height, int dock_height) {
    tw->layout =
        (DipLayout){.width = 2 * width + DIP_PANE_GAP_PX,
                    .height = height + dock_height,
                    .scale = 1.0,
                    .panes = {{0, 0, width, height}, {width + DIP_PANE_GAP_PX, 0, width, height}},
                    .side = DIP_DOCK_BELOW};
    tw->layout.body = (DipRect){0, height, tw->layout.width, dock_height};
}

void dip_tool_window_open(DipToolWindow *tw, DipTestSceneKind kind, int pane_width, int pane_height,
                          int dock_height) {
    memset(tw, 0, sizeof *tw);
    dip_test_scene_make(&tw->scene, kind);
    tw->pose = tw->scene.pose;
    make_session(tw, pane_width, pane_height);
    make_layout(tw, pane_width, pane_height, dock_height);
    tw->font = dip_font_create(NULL);
    tw->list = dip_draw_list_create(tw->font, NULL);
    tw->ui = dip_ui_create(NULL);
    tw->tools = dip_tools_create(NULL);
    assert_true(tw->session.scene && tw->font && tw->list && tw->ui && tw->tools);
    tw->state.track = &tw->session.track;
    tw->state.edited[DIP_PANE_REQUESTED] = true;
    tw->state.tools = (DipToolState){
        .open = true, .tab = DIP_TAB_LOUPE, .ui_scale = 1.0, .zoom = 16, .divider = 0.5, .gain = 1};
    tw->window = (DipWindow){.state = &tw->state,
                             .layout = &tw->layout,
                             .still = true,
                             .figures = tw->figures,
                             .tools = tw->tools};
    dip_tool_window_draw_frames(tw, "aa=none", "aa=4", 1);
}

void dip_tool_window_close(DipToolWindow *tw) {
    dip_tools_destroy(&tw->tools);
    dip_ui_destroy(&tw->ui);
    dip_draw_list_destroy(&tw->list);
    dip_font_destroy(&tw->font);
    dip_canvas_free(&tw->canvas);
    for (int p = 0; p < DIP_PANE_COUNT; ++p) {
        dip_painter_destroy(&tw->session.renderers[p]);
    }
    dip_campath_destroy(&tw->path);
    dip_scene_destroy(&tw->session.scene);
    dip_pool_destroy(&tw->session.pool);
    dip_test_scene_free(&tw->scene);
}

void dip_tool_window_draw_frames(DipToolWindow *tw, const char *current, const char *requested,
                                 int divisor) {
    const char *const texts[DIP_PANE_COUNT] = {current, requested};
    for (int p = 0; p < DIP_PANE_COUNT; ++p) {
        DipPainter *painter = tw->session.renderers[p];
        assert_true(dip_quality_parse(texts[p], &tw->state.quality[p], NULL));
        assert_true(dip_painter_set_quality(painter, &tw->state.quality[p], NULL));
        assert_true(dip_painter_resize(painter, tw->layout.panes[p].width / divisor,
                                       tw->layout.panes[p].height / divisor, NULL));
    }
    assert_true(dip_session_draw_pose(&tw->session, &tw->pose, tw->state.play_ns, tw->frame_index,
                                      &tw->frame, NULL));
    for (int p = 0; p < DIP_PANE_COUNT; ++p) {
        tw->window.frames[p] = dip_frame_pixels(&tw->frame.panes[p]);
        tw->window.versions[p] = ++tw->version;
    }
}

// Declares the parts of the window that the tools draw.
static void declare(DipToolWindow *tw) {
    DipUiInput panes[DIP_PANE_COUNT];
    dip_compare_pictures(tw->ui, &tw->window);
    for (int p = 0; p < DIP_PANE_COUNT; ++p) {
        const DipUiControl control = {
            .id = DIP_UI_ID(DIP_UI_PANES, p), .rect = tw->layout.panes[p], .takes_wheel = true};
        panes[p] = dip_ui_control(tw->ui, &control);
    }
    dip_maps_over_panes(tw->ui, &tw->window, panes);
    dip_compare_over_panes(tw->ui, &tw->window, panes);
    dip_loupe_over_panes(tw->ui, &tw->window, panes);
    if (tw->state.tools.tab == DIP_TAB_LOUPE) {
        dip_tab_loupe(tw->ui, &tw->window, tw->layout.body);
    } else {
        dip_tab_compare(tw->ui, &tw->window, tw->layout.body);
    }
}

static DipUiPass pass_of(const DipToolWindow *tw) {
    return (DipUiPass){.font = tw->font, .scale = tw->layout.scale, .now_ns = tw->now_ns};
}

void dip_tool_window_draw(DipToolWindow *tw) {
    DipUiPass pass = pass_of(tw);
    DipDamage damage;
    pass.list = tw->list;
    tw->window.now_ns = tw->now_ns;
    dip_draw_list_begin(tw->list, tw->layout.width, tw->layout.height);
    dip_draw_list_fill(tw->list, (DipRect){0, 0, tw->layout.width, tw->layout.height}, ground);
    dip_ui_begin(tw->ui, &pass);
    declare(tw);
    dip_ui_end(tw->ui);
    assert_true(dip_draw_list_paint(tw->list, &tw->canvas, &damage, NULL));
}

bool dip_tool_window_event(DipToolWindow *tw, const DipEvent *event) {
    DipUiPass pass = pass_of(tw);
    pass.event = event;
    dip_ui_begin(tw->ui, &pass);
    declare(tw);
    return dip_ui_end(tw->ui);
}

void dip_tool_window_mouse(DipToolWindow *tw, DipEventKind kind, DipMouseButton button, int x,
                           int y) {
    const DipEvent event = {.kind = kind, .button = button, .x = x, .y = y, .clicks = 1};
    dip_tool_window_event(tw, &event);
}

bool dip_tool_window_update(DipToolWindow *tw) {
    const DipToolsInput input = {.session = &tw->session,
                                 .pose = &tw->pose,
                                 .play_ns = tw->state.play_ns,
                                 .frame_index = tw->frame_index,
                                 .versions = {tw->window.versions[0], tw->window.versions[1]},
                                 .width = tw->window.frames[0].width,
                                 .height = tw->window.frames[0].height,
                                 .copied = tw->frame.copied,
                                 .still = tw->window.still,
                                 .loupe = dip_loupe_is_on(&tw->state.tools)};
    return dip_tools_update(tw->tools, &input);
}

const uint8_t *dip_tool_window_pixel(const DipToolWindow *tw, int x, int y) {
    return tw->canvas.rgba8 + 4 * ((size_t)y * (size_t)tw->canvas.width + (size_t)x);
}

const uint8_t *dip_tool_window_frame_pixel(const DipToolWindow *tw, int pane, int x, int y) {
    const DipPixels *frame = &tw->window.frames[pane];
    return frame->rgba8 + (size_t)y * frame->stride_bytes + 4 * (size_t)x;
}
