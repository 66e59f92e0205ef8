// Tests of plots: what the file must contain in any layout.
#include "app/report/page/plot.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

static char text[1 << 16];

static const char *written(const DipPlot *plot) {
    char file[] = "/tmp/dip_plot_XXXXXX";
    const int descriptor = mkstemp(file);
    assert_true(descriptor >= 0);
    close(descriptor);
    assert_true(dip_plot_write(file, plot, NULL));
    FILE *in = fopen(file, "r");
    assert_non_null(in);
    text[fread(text, 1, sizeof text - 1, in)] = '\0';
    fclose(in);
    remove(file);
    return text;
}

static int count_of(const char *word) {
    int count = 0;
    for (const char *at = strstr(text, word); at; at = strstr(at + 1, word)) {
        count++;
    }
    return count;
}

static DipPlot make(const DipPlotSeries *series, int count, bool logarithmic) {
    return (DipPlot){"Title", "Sub", "pixels", "ms", logarithmic, logarithmic, series, count, NULL};
}

static void plots_contain_names_and_marks(void **state) {
    (void)state;
    const double x[] = {1, 2, 4};
    const double y[] = {3, 5, 9};
    const DipPlotSeries series[] = {{.name = "a < b & c", .x = x, .y = y, .count = 3},
                                    {.name = "d", .x = x, .y = y, .low = x, .high = y, .count = 2}};
    const DipPlot plot = make(series, 2, false);
    written(&plot);
    assert_int_equal(count_of(">a &lt; b &amp; c<"), 1);
    assert_int_equal(count_of(">pixels<"), 1);
    assert_int_equal(count_of(">ms<"), 1);
    assert_int_equal(count_of("<circle"), 5 + 2); // the points and the legend's marks
    assert_int_equal(count_of("stroke-opacity"), 2);
    assert_int_equal(count_of("</svg>"), 1);
    assert_int_equal(count_of("nan") + count_of("inf"), 0);
}

// A series that has only marks has no line, neither in the plot nor in the legend. Each mark has
// its number.
static void marks_without_a_line_have_numbers(void **state) {
    (void)state;
    const double x[] = {1, 2, 4};
    DipPlotSeries series = {.name = "s", .x = x, .y = x, .count = 3, .marks_only = true};
    const DipPlot plot = make(&series, 1, true);
    written(&plot);
    const int others = count_of(">3<"); // Such as the values on the axes.
    series.numbered = true;
    written(&plot);
    assert_int_equal(count_of("<circle"), 3 + 1);
    assert_int_equal(count_of("<polyline"), 0);
    assert_int_equal(count_of("stroke-width=\"2\""), 0);
    assert_int_equal(count_of(">3<"), others + 1);
    assert_int_equal(count_of("font-size=\"12\" text-anchor=\"end\""), 3);
}

// A page finds points by their rows, and browsers show their titles. The legend's marks have none.
static void points_have_rows_and_titles(void **state) {
    (void)state;
    const double x[] = {1, 2};
    const int rows[] = {7, 12};
    const char *const titles[] = {"a < b", "c"};
    const DipPlotSeries series = {
        .name = "s", .x = x, .y = x, .count = 2, .rows = rows, .titles = titles};
    DipPlot plot = make(&series, 1, true);
    plot.set = "front";
    written(&plot);
    assert_int_equal(count_of("class=\"point\""), 2);
    assert_int_equal(count_of("data-row=\"7\"") + count_of("data-row=\"12\""), 2);
    assert_int_equal(count_of("<title>a &lt; b</title></circle>"), 1);
    assert_int_equal(count_of("data-set=\"front\""), 1);
}

// On logarithmic axes, equal factors give equal distances. So these three points lie on one line.
static void powers_lie_on_a_line(void **state) {
    (void)state;
    const double x[] = {10, 100, 1000};
    const double y[] = {1, 2, 4};
    const DipPlotSeries series = {.name = "s", .x = x, .y = y, .count = 3};
    const DipPlot plot = make(&series, 1, true);
    double at[6];
    const char *points = strstr(written(&plot), "points=");
    assert_non_null(points);
    assert_int_equal(sscanf(points, "points=\"%lf,%lf %lf,%lf %lf,%lf\"", &at[0], &at[1], &at[2],
                            &at[3], &at[4], &at[5]),
                     6);
    assert_true(at[0] < at[2] && at[1] > at[3]); // y grows downwards
    for (int axis = 0; axis < 2; axis++) {
        const double bend = at[axis] + at[4 + axis] - 2.0 * at[2 + axis];
        assert_true(bend > -0.21 && bend < 0.21); // coordinates are rounded to a tenth of a pixel
    }
}

static void many_series_of_one_point_can_be_plotted(void **state) {
    (void)state;
    const double one[] = {5};
    DipPlotSeries series[DIP_PLOT_MAX_SERIES + 2];
    for (int i = 0; i < DIP_PLOT_MAX_SERIES + 2; i++) {
        series[i] = (DipPlotSeries){.name = "s", .x = one, .y = one, .count = 1};
    }
    const DipPlot plot = make(series, DIP_PLOT_MAX_SERIES + 2, true);
    written(&plot);
    assert_int_equal(count_of("and 2 more"), 1);
    assert_int_equal(count_of("nan") + count_of("inf"), 0);
}

static void a_missing_folder_is_an_error(void **state) {
    (void)state;
    const double one[] = {5};
    const DipPlotSeries series = {.name = "s", .x = one, .y = one, .count = 1};
    const DipPlot plot = make(&series, 1, false);
    DipError err = {0};
    assert_false(dip_plot_write("/none/at/all.svg", &plot, &err));
    assert_int_equal(err.code, DIP_ERROR_IO);
    assert_string_equal(err.file, "/none/at/all.svg");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(plots_contain_names_and_marks),
        cmocka_unit_test(marks_without_a_line_have_numbers),
        cmocka_unit_test(points_have_rows_and_titles),
        cmocka_unit_test(powers_lie_on_a_line),
        cmocka_unit_test(many_series_of_one_point_can_be_plotted),
        cmocka_unit_test(a_missing_folder_is_an_error),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
