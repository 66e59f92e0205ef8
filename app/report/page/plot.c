// Lays out plots and writes them as SVG.
#include "app/report/page/plot.h"

#include "app/files/whole_file.h"
#include "app/files/put.h"

#include <math.h>
#include <stdio.h>

// The layout, in pixels.
enum {
    WIDTH = 760,
    LEFT = 78,
    RIGHT = 736,
    TOP = 64,
    BOTTOM = 404,
    LEGEND_TOP = 476,
    LEGEND_LINE = 20,
    LEGEND_WIDTH = 340, // Width of a column of the legend.
    MOST_BARRED = 4,    // A plot with more series has no bars.
    MAX_TICKS = 16,
    TICK_ROOM = 46 // Least distance between two labels of the x axis.
};

// Six of the eight colours of Okabe and Ito's palette; orange and yellow are left out. Colour-blind
// readers can tell these colours apart. Lines after the sixth use the colours again and are dashed.
static const char *const colours[] = {"#0072b2", "#d55e00", "#009e73",
                                      "#cc79a7", "#56b4e9", "#000000"};
enum { COLOUR_COUNT = sizeof colours / sizeof *colours };

typedef struct Axis {
    double least; // Range in axis units, which are logarithms on a logarithmic axis.
    double most;
    double from; // Range in pixels.
    double to;
    bool logarithmic;
    double ticks[MAX_TICKS];
    int tick_count;
} Axis;

// Converts a value to axis units.
static double scaled(const Axis *axis, double value) {
    return axis->logarithmic ? log10(value) : value;
}

static double pixel(const Axis *axis, double value) {
    const double share = (scaled(axis, value) - axis->least) / (axis->most - axis->least);
    return axis->from + share * (axis->to - axis->from);
}

static int shown_series(const DipPlot *plot) {
    return plot->series_count < DIP_PLOT_MAX_SERIES ? plot->series_count : DIP_PLOT_MAX_SERIES;
}

// --- axes --------------------------------------------------------------------------------------

static void widen(Axis *axis, double value) {
    axis->least = fmin(axis->least, scaled(axis, value));
    axis->most = fmax(axis->most, scaled(axis, value));
}

// Adds a margin on both sides of the values, so that even a single value gets a range. If from_zero
// is true, a linear axis begins at 0.
static void add_margin(Axis *axis, bool from_zero) {
    double room = 0.06 * (axis->most - axis->least);
    if (!(room > 0.0)) {
        room = axis->logarithmic ? 0.2 : 0.2 * fabs(axis->most) + 1e-9;
    }
    axis->least = from_zero && !axis->logarithmic ? 0.0 : axis->least - room;
    axis->most += room;
}

static void add_tick(Axis *axis, double value) {
    const double at = scaled(axis, value);
    if (axis->tick_count < MAX_TICKS && at >= axis->least && at <= axis->most) {
        axis->ticks[axis->tick_count++] = value;
    }
}

// Puts ticks at 1, 2 and 5 times each power of ten. A wide range has ticks at the powers of ten
// only; a narrow range has ticks at every digit.
static void tick_logarithmic(Axis *axis) {
    const double decades = axis->most - axis->least;
    const int step = decades > 4.0 ? 9 : decades < 0.7 ? 1 : 0;
    for (int power = (int)floor(axis->least); power <= (int)ceil(axis->most); power++) {
        for (int digit = 1; digit <= 9; digit += step ? step : 1) {
            if (step || digit == 1 || digit == 2 || digit == 5) {
                add_tick(axis, digit * pow(10.0, power));
            }
        }
    }
}

static void tick_linear(Axis *axis) {
    static const double digits[] = {1.0, 2.0, 5.0, 10.0};
    const double wanted = (axis->most - axis->least) / 6.0;
    const double power = pow(10.0, floor(log10(wanted)));
    double step = power;
    for (int i = 0; step < wanted && i < 4; i++) {
        step = digits[i] * power;
    }
    for (double i = ceil(axis->least / step); i * step <= axis->most; i++) {
        add_tick(axis, i * step + 0.0); // Adding 0 turns -0 into 0.
    }
}

// If there are at most eight different x values, puts a tick at each value. Otherwise returns false
// and leaves no ticks.
static bool tick_values(Axis *axis, const DipPlot *plot) {
    for (int s = 0; s < shown_series(plot); s++) {
        for (int i = 0; i < plot->series[s].count; i++) {
            const double value = plot->series[s].x[i];
            bool known = false;
            for (int t = 0; t < axis->tick_count; t++) {
                known = known || axis->ticks[t] == value;
            }
            if (!known && axis->tick_count == 8) {
                axis->tick_count = 0;
                return false;
            }
            if (!known) {
                add_tick(axis, value);
            }
        }
    }
    return true;
}

static Axis make_axis(const DipPlot *plot, bool is_y) {
    Axis axis = {INFINITY, -INFINITY, LEFT, RIGHT, plot->log_x, {0}, 0};
    if (is_y) {
        axis = (Axis){INFINITY, -INFINITY, BOTTOM, TOP, plot->log_y, {0}, 0};
    }
    for (int s = 0; s < shown_series(plot); s++) {
        const DipPlotSeries *series = &plot->series[s];
        for (int i = 0; i < series->count; i++) {
            widen(&axis, is_y ? series->y[i] : series->x[i]);
            if (is_y && series->low && series->high) {
                widen(&axis, series->low[i]);
                widen(&axis, series->high[i]);
            }
        }
    }
    add_margin(&axis, is_y);
    if (is_y || !tick_values(&axis, plot)) {
        axis.logarithmic ? tick_logarithmic(&axis) : tick_linear(&axis);
    }
    return axis;
}

// --- writing -----------------------------------------------------------------------------------

static void write_text(FILE *out, double x, double y, const char *attributes, const char *text) {
    dip_put_html(out, "<text x=\"%.1f\" y=\"%.1f\" ", x, y);
    dip_put_markup(out, attributes);
    dip_put_html(out, ">%s</text>\n", text);
}

static void write_line(FILE *out, double x0, double y0, double x1, double y1, const char *style) {
    dip_put_html(out, "<line x1=\"%.1f\" y1=\"%.1f\" x2=\"%.1f\" y2=\"%.1f\" ", x0, y0, x1, y1);
    dip_put_markup(out, style);
    dip_put_markup(out, "/>\n");
}

// Writes a short number: "307k", "1.23M", "0.5".
static void format_number(double value, char text[32]) {
    if (fabs(value) >= 1e6) {
        snprintf(text, 32, "%.3gM", value / 1e6);
    } else if (fabs(value) >= 1e4) {
        snprintf(text, 32, "%.3gk", value / 1e3);
    } else {
        snprintf(text, 32, "%.4g", value);
    }
}

static void write_axes(FILE *out, const DipPlot *plot, const Axis *x, const Axis *y) {
    char text[32];
    double free_from = -INFINITY;
    for (int i = 0; i < y->tick_count; i++) {
        const double at = pixel(y, y->ticks[i]);
        format_number(y->ticks[i], text);
        write_line(out, LEFT, at, RIGHT, at, "class=\"plot-grid\" stroke=\"#d8d8d8\"");
        write_text(out, LEFT - 8, at + 4.5, "text-anchor=\"end\"", text);
    }
    for (int i = 0; i < x->tick_count; i++) {
        const double at = pixel(x, x->ticks[i]);
        format_number(x->ticks[i], text);
        write_line(out, at, TOP, at, BOTTOM + 5, "class=\"plot-grid\" stroke=\"#d8d8d8\"");
        if (at >= free_from) {
            write_text(out, at, BOTTOM + 21, "text-anchor=\"middle\"", text);
            free_from = at + TICK_ROOM;
        }
    }
    write_line(out, LEFT, BOTTOM, RIGHT, BOTTOM, "class=\"plot-axis\" stroke=\"#404040\"");
    write_line(out, LEFT, TOP, LEFT, BOTTOM, "class=\"plot-axis\" stroke=\"#404040\"");
    write_text(out, (LEFT + RIGHT) / 2.0, BOTTOM + 46, "text-anchor=\"middle\"", plot->x_title);
    dip_put_html(out, "<g transform=\"translate(20 %.1f) rotate(-90)\">", (TOP + BOTTOM) / 2.0);
    write_text(out, 0, 0, "text-anchor=\"middle\"", plot->y_title);
    dip_put_html(out, "</g>\n");
}

static const char *dash_of(int index) {
    return index < COLOUR_COUNT ? "none" : "7 4";
}

// Begins the <g> element of a series' line and marks, or of its entry in the legend.
static void begin_group(FILE *out, const DipPlotSeries *series, int index) {
    const char *colour = colours[index % COLOUR_COUNT];
    if (series->style) {
        dip_put_html(out, "<g class=\"%s\"", series->style);
    } else {
        dip_put_html(out, "<g class=\"series-%d\"", index);
    }
    dip_put_html(out, " stroke=\"%s\" fill=\"%s\">", colour, colour);
}

static void write_point(FILE *out, const DipPlotSeries *series, int index, double x, double y) {
    dip_put_html(out, "<circle cx=\"%.1f\" cy=\"%.1f\" r=\"3.5\"", x, y);
    if (series->rows && series->rows[index] >= 0) {
        dip_put_html(out, " class=\"point\" data-row=\"%d\"", series->rows[index]);
    }
    if (series->titles) {
        dip_put_html(out, "><title>");
        dip_put_html(out, "%s", series->titles[index]);
        dip_put_html(out, "</title></circle>\n");
    } else {
        dip_put_html(out, "/>\n");
    }
}

static void write_series(FILE *out, const DipPlotSeries *series, int index, bool bars,
                         const Axis *x, const Axis *y) {
    begin_group(out, series, index);
    for (int i = 0; bars && series->low && series->high && i < series->count; i++) {
        const double at = pixel(x, series->x[i]);
        write_line(out, at, pixel(y, series->low[i]), at, pixel(y, series->high[i]),
                   "stroke-opacity=\"0.4\" stroke-width=\"5\"");
    }
    if (!series->marks_only) {
        dip_put_html(out,
                     "<polyline fill=\"none\" stroke-width=\"2\" stroke-dasharray=\"%s\" points=\"",
                     dash_of(index));
        for (int i = 0; i < series->count; i++) {
            dip_put_html(out, "%s%.1f,%.1f", i ? " " : "", pixel(x, series->x[i]),
                         pixel(y, series->y[i]));
        }
        dip_put_html(out, "\"/>\n");
    }
    for (int i = 0; i < series->count; i++) {
        write_point(out, series, i, pixel(x, series->x[i]), pixel(y, series->y[i]));
    }
    dip_put_html(out, "</g>\n");
    for (int i = 0; series->numbered && i < series->count; i++) {
        char number[12];
        snprintf(number, sizeof number, "%d", i + 1);
        write_text(out, pixel(x, series->x[i]) - 4.0, pixel(y, series->y[i]) + 14.0,
                   "font-size=\"12\" text-anchor=\"end\"", number);
    }
}

// Writes an entry of the legend. The entries fill two columns, row by row.
static void write_legend_entry(FILE *out, const DipPlotSeries *series, int index) {
    const double x = LEFT + LEGEND_WIDTH * (index % 2);
    const double y = LEGEND_TOP + LEGEND_LINE * (index / 2);
    begin_group(out, series, index);
    if (!series->marks_only) {
        dip_put_html(out,
                     "<line x1=\"%.1f\" y1=\"%.1f\" x2=\"%.1f\" y2=\"%.1f\" stroke-width=\"2\" "
                     "stroke-dasharray=\"%s\"/>",
                     x, y, x + 34, y, dash_of(index));
    }
    dip_put_html(out, "<circle cx=\"%.1f\" cy=\"%.1f\" r=\"3.5\"/></g>\n", x + 17, y);
    write_text(out, x + 44, y + 4.5, "", series->name);
}

void dip_plot_print(FILE *out, const DipPlot *plot) {
    const Axis x = make_axis(plot, false);
    const Axis y = make_axis(plot, true);
    const int shown = shown_series(plot);
    const int left_out = plot->series_count - shown;
    const int height = LEGEND_TOP + LEGEND_LINE * ((shown + 1) / 2 + (left_out > 0)) + 2;
    dip_put_html(
        out,
        "<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"plot\" viewBox=\"0 0 %d %d\" "
        "width=\"%d\" height=\"%d\" font-family=\"Helvetica, Arial, 'DejaVu Sans', sans-serif\" "
        "font-size=\"13\" fill=\"#202020\" data-set=\"%s\">\n<rect class=\"plot-paper\" "
        "width=\"100%%\" "
        "height=\"100%%\" fill=\"#ffffff\"/>\n",
        WIDTH, height, WIDTH, height, plot->set ? plot->set : "");
    write_text(out, LEFT, 27, "font-size=\"17\" font-weight=\"bold\"", plot->title);
    write_text(out, LEFT, 47, "class=\"plot-note\" fill=\"#606060\"", plot->subtitle);
    write_axes(out, plot, &x, &y);
    for (int s = 0; s < shown; s++) {
        write_series(out, &plot->series[s], s, shown <= MOST_BARRED, &x, &y);
        write_legend_entry(out, &plot->series[s], s);
    }
    if (left_out > 0) {
        char text[64];
        snprintf(text, sizeof text, "and %d more, which are not drawn", left_out);
        write_text(out, LEFT + 44, LEGEND_TOP + LEGEND_LINE * ((shown + 1) / 2) + 4.5, "", text);
    }
    dip_put_html(out, "</svg>\n");
}

static bool print_plot(const void *plot, FILE *out) {
    dip_plot_print(out, plot);
    return true;
}

bool dip_plot_write(const char *file, const DipPlot *plot, DipError *err) {
    return dip_whole_file_print(file, print_plot, plot, err);
}
