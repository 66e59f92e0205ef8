// Saying where prices come from and for what they hold.
#include "app/preview/prices/prices_private.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

typedef struct Text {
    char *at;
    size_t size_bytes;
} Text;

__attribute__((format(printf, 2, 3))) static void say(Text *text, const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    const int length = vsnprintf(text->at, text->size_bytes, format, arguments);
    va_end(arguments);
    const size_t left = text->size_bytes > 0 ? text->size_bytes - 1 : 0;
    const size_t used = length > 0 && (size_t)length < left ? (size_t)length : left;
    text->at += used;
    text->size_bytes -= used;
}

static bool differs(const char *now, const char *then) {
    return now && strcmp(now, then) != 0;
}

// Says what differs between the report and the panes. Returns whether anything does.
static bool say_differences(const DipPrices *prices, int width, int height, Text *text) {
    const DipPriceReport *report = &prices->report;
    const DipPriceConditions *now = &prices->conditions;
    bool stale = false;
    if (differs(now->scene, report->scene)) {
        say(text, " The panes show %s.", now->scene);
        stale = true;
    }
    if (width != report->width || height != report->height) {
        say(text, " The panes are %dx%d.", width, height);
        stale = true;
    }
    if (dip_prices_viewing(prices) != report->pixels_per_degree) {
        say(text, " FLIP of the panes is for %.1f pixels per degree, that of the report for %.1f.",
            dip_prices_viewing(prices), report->pixels_per_degree);
        stale = true;
    }
    if (now->threads != 0 && now->threads != report->threads) {
        say(text, " The panes have %d thread%s.", now->threads, now->threads == 1 ? "" : "s");
        stale = true;
    }
    if (differs(now->processor, report->processor)) {
        say(text, " The report is from another machine.");
        stale = true;
    } else if (differs(now->isa, report->isa)) {
        say(text, " The report is for %s, the panes use %s.", report->isa, now->isa);
        stale = true;
    }
    return stale;
}

bool dip_prices_are_of_other_scene(const DipPrices *prices) {
    return prices->has_report && differs(prices->conditions.scene, prices->report.scene);
}

bool dip_prices_are_doubtful(const DipPrices *prices) {
    return dip_prices_are_rough(prices) ? prices->rough_doubtful : prices->report.doubtful;
}

bool dip_prices_source(const DipPrices *prices, int width, int height, char *out,
                       size_t size_bytes) {
    const DipPriceReport *report = &prices->report;
    Text text = {out, size_bytes};
    if (dip_prices_are_rough(prices)) {
        say(&text, "%s",
            prices->rough.count > 0
                ? "Prices: measured here, in this picture, a few frames each (rough)."
                : "Prices: not measured yet. They are measured while the camera rests.");
        return false;
    }
    say(&text, "Prices: report of %.80s, path %s, %dx%d, %d thread%s.",
        differs(prices->conditions.scene, report->scene) ? report->scene : "this scene",
        report->path, report->width, report->height, report->threads,
        report->threads == 1 ? "" : "s");
    const bool stale = say_differences(prices, width, height, &text);
    if (report->doubtful) {
        say(&text, " The machine was too busy, so the times are wrong.");
    }
    if (!report->has_times) {
        say(&text, " The report has no times.");
    }
    if (!report->has_errors) {
        say(&text, " The report has no errors.");
    }
    return stale;
}
