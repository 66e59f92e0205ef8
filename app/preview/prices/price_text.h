// Writes prices as the panel shows them, and the tips that explain the steps (values) of settings.
#ifndef DIP_APP_PREVIEW_PRICES_PRICE_TEXT_H
#define DIP_APP_PREVIEW_PRICES_PRICE_TEXT_H

#include "app/preview/prices/prices.h"
#include "renderer/scene/quality.h"

#include <stdbool.h>
#include <stddef.h>

// The mark before rough times, which come from a few frames or from adding prices.
#define DIP_ROUGH_MARK "\u2248 "

// What stands in the place of a number or a picture that is not known yet.
#define DIP_WAITING_MARK "\u00b7 \u00b7 \u00b7"

enum { DIP_STEP_NAME_BYTES = 24, DIP_STEP_TEXT_BYTES = 900 };

// Writes a number as dip_number_text does (app/report/words.h), with the sign U+2212 if it is
// negative. All negative numbers in the window, and in the panel of a display that shows
// characters, have this sign: they are written by this function, by dip_ms_text or by
// dip_flip_text.
void dip_panel_number(double value, int decimals, bool change, char text[DIP_STEP_NAME_BYTES]);

// Writes a time without its unit as dip_ms_number does (app/report/words.h): "8.4", or "8?" if it
// is doubtful. Rounding never carries the time over the budget.
void dip_ms_text(double ms, DipPriceTrust trust, double budget_ms, char text[DIP_STEP_NAME_BYTES]);

// Writes a price's time without its unit, by its trust: "+1.2", "≈ +1.2" if it is rough, "~+1.2" if
// a model predicts it, "+1?" if it is doubtful, "≈ 0", or "base". If the time is unknown, writes
// dots, or a dash if the setting has no effect without another setting. Rounding never carries the
// time of a frame with the step (the price and the time without the step) over the budget.
void dip_price_ms_text(const DipPrice *price, double budget_ms, char text[DIP_STEP_NAME_BYTES]);

// Writes a FLIP error without the zero before the point: ".0354". If `change` is true, the number
// is a change and gets a sign.
void dip_flip_text(double flip, bool change, char text[DIP_STEP_NAME_BYTES]);

// Writes a price's FLIP as dip_flip_text does. If FLIP is unknown, writes dots, or a dash if the
// setting has no effect without another setting.
void dip_price_flip_text(const DipPrice *price, char text[DIP_STEP_NAME_BYTES]);

// Writes the tip of a step: what the step does, and its price, which the steps of mipdebug lack.
// why: why the step cannot be chosen, or "" if it can. budget_ms: as in dip_price_ms_text.
void dip_step_tip(DipSetting setting, int step, const DipPrice *price, double budget_ms,
                  const char *why, char text[DIP_STEP_TEXT_BYTES]);

#endif
