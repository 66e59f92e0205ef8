// Interactions of settings in the HTML page.
#include "app/report/page/html_parts.h"

#include "app/report/format/analysis.h"
#include "app/files/put.h"

static void write_interaction(const DipCostInteraction *interaction, FILE *out) {
    dip_put_html(out, "<tr><th scope=\"row\">%s and %s</th>", dip_setting_info(interaction->a)->key,
                 dip_setting_info(interaction->b)->key);
    if (interaction->time > 0.0) {
        dip_put_html(out, "<td>%.3f</td>", interaction->time);
    } else {
        dip_put_html(out, "<td></td>");
    }
    dip_put_html(out, "<td>%+.5f</td><td>%d</td></tr>\n", interaction->flip, interaction->contexts);
}

void dip_html_interactions(const DipCostReport *report, FILE *out) {
    const DipCostInteraction *list = report->analysis ? report->analysis->interactions : NULL;
    const int count = list ? report->analysis->interaction_count : 0;
    if (count == 0) {
        return;
    }
    dip_put_html(out, "<h2 id=\"interactions\">Two settings together</h2>\n");
    dip_html_table_begin(out, "interaction-table", NULL);
    dip_put_html(out,
                 "Two settings at their last steps, against each alone: means over the "
                 "combinations of the other settings. A time above 1 means that both together cost "
                 "more than the product of their ratios. A FLIP above 0 means that both together "
                 "lower FLIP by less than the sum of what each lowers it.");
    dip_html_columns_begin(out);
    dip_html_text_column(out, "settings");
    dip_html_column(out, "time", "factor");
    dip_html_column(out, "FLIP", "difference");
    dip_html_column(out, "combinations", "of the others");
    dip_html_columns_end(out);
    for (int i = 0; i < count; i++) {
        write_interaction(&list[i], out);
    }
    dip_html_table_end(out);
}
