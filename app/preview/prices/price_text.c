// Writes prices, and the tips that explain the steps of settings.
#include "app/preview/prices/price_text.h"

#include "app/report/words.h"

#include <stdio.h>
#include <string.h>

// What each step of each setting does.
static const char *const explanations[DIP_SETTING_COUNT][DIP_MAX_STEPS] = {
    [DIP_SETTING_AA] = {"One sample per pixel, so edges are stair-stepped.",
                        "Two samples per pixel for edges; surfaces are shaded once.",
                        "Four samples per pixel for edges; surfaces are shaded once.",
                        "Six samples per pixel for edges; surfaces are shaded once.",
                        "Eight samples per pixel for edges; surfaces are shaded once."},
    [DIP_SETTING_TAA] = {"Every frame uses the same sample pattern.",
                         "Two sample patterns alternate from frame to frame, so a moving "
                         "picture shows twice as many samples.",
                         "Each frame is blended with the frames before it, as the camera has "
                         "moved them (games call it TAA): smooth edges and less flicker, but "
                         "thin wires vanish, and things that move by themselves smear."},
    [DIP_SETTING_AAA] = {"Leaves and fences have stair-stepped edges: their holes are cut once "
                         "per pixel.",
                         "Leaves and fences cover as many samples as their alpha says (alpha "
                         "to coverage): nearly as smooth, for little time.",
                         "The holes of leaves and fences are cut and shaded once per group of "
                         "samples.",
                         "Every surface is shaded once per group of samples (supersampling): "
                         "the sharpest picture, which takes the longest."},
    [DIP_SETTING_ASD] = {"Each sample is a group of its own: the smoothest holes.",
                         "Two samples share a group.", "Three samples share a group.",
                         "Four samples share a group: the fastest."},
    [DIP_SETTING_AF] = {"Trilinear: surfaces seen at a low angle are blurred.",
                        "Up to 2 texture probes along the long axis of a footprint.",
                        "Up to 4 texture probes along the long axis of a footprint.",
                        "Up to 8 texture probes along the long axis of a footprint.",
                        "Up to 16 texture probes along the long axis of a footprint."},
    [DIP_SETTING_AAF] = {"Footprints are estimated, so sharpness depends on a surface's angle.",
                         "Footprints are exact ellipses, so sharpness does not depend on a "
                         "surface's angle."},
    [DIP_SETTING_OPT] = {"Textures are drawn as they are.",
                         "Colour textures are compressed with BC1.",
                         "Colour textures are compressed and filtered with fewer probes."},
    [DIP_SETTING_MIPLOD] = {"Much smaller mip levels, and the largest ones are dropped.",
                            "Smaller mip levels: textures are blurred.",
                            "Slightly smaller mip levels.", "The mip level that fits each pixel.",
                            "Half a mip level sharper than the texture's size asks for.",
                            "A mip level sharper than the texture's size asks for: fine "
                            "patterns may shimmer when the camera moves."},
    [DIP_SETTING_SCALE] = {"A picture half as wide and high is drawn and enlarged; games call it "
                           "performance.",
                           "A picture 1.7 times smaller each way is drawn and enlarged; games "
                           "call it balanced.",
                           "A picture 1.5 times smaller each way is drawn and enlarged; games "
                           "call it quality.",
                           "A picture 1.3 times smaller each way is drawn and enlarged; games "
                           "call it ultra quality.",
                           "The picture is drawn in its own size.",
                           "A picture 1.25 times as wide and high is drawn and averaged.",
                           "A picture 1.5 times as wide and high is drawn and averaged.",
                           "A picture twice as wide and high is drawn, and four of its pixels "
                           "make one: edges and textures gain, and a frame takes about three "
                           "times as long."},
    [DIP_SETTING_UPSCALE] =
        {"Each pixel blends the four nearest pixels of the smaller picture: "
         "soft, and the fastest.",
         "Each pixel is a sum of sixteen pixels of the smaller picture: crisper.",
         "Pixels are blended along edges (FSR 1): smooth edges, but it "
         "takes the longest."},
    [DIP_SETTING_POST] = {"The picture stays as it is drawn.",
                          "FXAA finds edges in the finished picture and blurs along them; "
                          "textures and text get softer, too.",
                          "SMAA finds edges in the finished picture and replaces their stairs "
                          "by lines; thin wires stay broken."},
    [DIP_SETTING_SHARPEN] = {"The picture stays as it is drawn.",
                             "A quarter of the strongest sharpening. The error rises.",
                             "Half of the strongest sharpening. The error rises.",
                             "The strongest sharpening that does not overshoot. The error "
                             "rises."},
    [DIP_SETTING_SHADOWS] = {"Nothing casts a shadow.",
                             "The strongest directional light casts shadows from a map of "
                             "512x512 texels: their edges are wide and soft.",
                             "A map of 1024x1024 texels: the edges are half as wide.",
                             "A map of 2048x2048 texels: the edges are a quarter as wide."},
    [DIP_SETTING_GI] = {"Each repeated object has a copy of its mesh; the picture is the same.",
                        "Repeated objects share one mesh; the picture is the same."},
    [DIP_SETTING_MIPDEBUG] = {"Textures show their own colours.",
                              "Each mip level of a colour texture shows as a flat colour."},
};

static const char minus[] = "\u2212"; // The sign of negative numbers in the window.

void dip_panel_number(double value, int decimals, bool change, char text[DIP_STEP_NAME_BYTES]) {
    dip_number_text(value, decimals, change, minus, text);
}

void dip_ms_text(double ms, DipPriceTrust trust, double budget_ms, char text[DIP_STEP_NAME_BYTES]) {
    dip_ms_number(ms, trust == DIP_PRICE_TRUST_DOUBTFUL, budget_ms, minus, text);
}

void dip_price_ms_text(const DipPrice *price, double budget_ms, char text[DIP_STEP_NAME_BYTES]) {
    const DipPriceTrust trust = dip_price_trust(price);
    char digits[DIP_STEP_NAME_BYTES];
    if (trust == DIP_PRICE_TRUST_UNKNOWN) {
        snprintf(text, DIP_STEP_NAME_BYTES, "%s",
                 price->needs_company ? "\u2013" : DIP_WAITING_MARK);
    } else if (price->state == DIP_PRICE_BASE) {
        snprintf(text, DIP_STEP_NAME_BYTES, "base");
    } else if (trust == DIP_PRICE_TRUST_ZERO) {
        snprintf(text, DIP_STEP_NAME_BYTES, "\u2248 0");
    } else {
        const char *mark = trust == DIP_PRICE_TRUST_DOUBTFUL     ? ""
                           : price->state == DIP_PRICE_ROUGH     ? DIP_ROUGH_MARK
                           : price->state == DIP_PRICE_PREDICTED ? "~"
                                                                 : "";
        dip_ms_text(price->ms, trust, budget_ms - price->without_ms, digits);
        const bool has_plus = price->ms > 0.0 && digits[strspn(digits, "0.")] != '?';
        snprintf(text, DIP_STEP_NAME_BYTES, "%s%s%.16s", mark, has_plus ? "+" : "", digits);
    }
}

void dip_flip_text(double flip, bool change, char text[DIP_STEP_NAME_BYTES]) {
    dip_flip_number(flip, change, minus, text);
}

void dip_price_flip_text(const DipPrice *price, char text[DIP_STEP_NAME_BYTES]) {
    text[0] = '\0';
    if (price->has_flip) {
        dip_flip_text(price->flip, price->state != DIP_PRICE_BASE, text);
    } else {
        snprintf(text, DIP_STEP_NAME_BYTES, "%s",
                 price->needs_company ? "\u2013" : DIP_WAITING_MARK);
    }
}

// Writes what is known of a doubtful time, and why it is doubtful. Leaves out an interval that is
// wider than the frame's time without the step, since it says nothing.
static void format_doubt(const DipPrice *price, char *text, size_t size_bytes) {
    const char *why = price->doubtful ? "the machine was too busy while it was measured"
                                      : "the times that it comes from differ too much";
    const double width = price->ms_high - price->ms_low;
    if (width <= price->without_ms) {
        const int decimals = width < 1.0 ? 2 : 1;
        char low[DIP_NUMBER_BYTES], high[DIP_NUMBER_BYTES];
        dip_panel_number(price->ms_low, decimals, true, low);
        dip_panel_number(price->ms_high, decimals, true, high);
        snprintf(text, size_bytes, "\nIts time is doubtful, between %s and %s ms: %s.", low, high,
                 why);
    } else {
        snprintf(text, size_bytes, "\nIts time cannot be told: %s.", why);
    }
}

static void format_price(const DipPrice *price, double budget_ms, char *text, size_t size_bytes) {
    char digits[DIP_STEP_NAME_BYTES], low[DIP_STEP_NAME_BYTES], high[DIP_STEP_NAME_BYTES];
    char flip[DIP_STEP_NAME_BYTES] = "", beside[64] = "", where[80] = "";
    text[0] = '\0';
    if (price->beside[0]) {
        snprintf(beside, sizeof beside, " beside %s", price->beside);
    }
    if (price->path[0]) { // A rough price has no path, since it is for one picture.
        snprintf(where, sizeof where, " on path %s", price->path);
    }
    if (price->has_flip) {
        dip_flip_text(price->flip, price->state != DIP_PRICE_BASE, flip);
    }
    switch (price->state) {
    case DIP_PRICE_BASE:
        dip_ms_text(price->ms, dip_price_trust(price), budget_ms, digits);
        snprintf(text, size_bytes, "\nThe base of all prices%s: %s ms%s%s.", where, digits,
                 flip[0] ? ", FLIP " : "", flip);
        break;
    case DIP_PRICE_MEASURED:
    case DIP_PRICE_PREDICTED:
    case DIP_PRICE_ROUGH:
        if (dip_price_trust(price) == DIP_PRICE_TRUST_DOUBTFUL) {
            format_doubt(price, text, size_bytes);
            break;
        }
        dip_panel_number(price->ms, 2, true, digits);
        dip_panel_number(price->ms_low, 2, true, low);
        dip_panel_number(price->ms_high, 2, true, high);
        snprintf(text, size_bytes, "\n%s ms (%s to %s)%s%s%s%s, %s.", digits, low, high,
                 flip[0] ? ", FLIP " : "", flip, beside, where,
                 price->state == DIP_PRICE_ROUGH       ? "roughly measured just now"
                 : price->state == DIP_PRICE_PREDICTED ? "predicted"
                                                       : "measured");
        break;
    default:
        snprintf(text, size_bytes, "\n%s%s.",
                 price->needs_company ? "It has no effect: it needs "
                                      : "Its price is not measured yet",
                 price->needs_company ? price->needs : "");
        break;
    }
}

void dip_step_tip(DipSetting setting, int step, const DipPrice *price, double budget_ms,
                  const char *why, char text[DIP_STEP_TEXT_BYTES]) {
    char cost[320];
    format_price(price, budget_ms, cost, sizeof cost);
    snprintf(text, DIP_STEP_TEXT_BYTES, "%s: %s%s%.300s%s%s",
             dip_setting_info(setting)->labels[step], explanations[setting][step],
             why[0] ? "\n" : "", why, setting == DIP_SETTING_MIPDEBUG ? "" : cost,
             price->has_flip ? "\nFLIP is the error that people see, from 0 (the same picture as "
                               "the converged one) to 1. A minus sign is a gain."
                             : "");
}
