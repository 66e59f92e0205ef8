// Declares the style sheets and scripts of a report's page. The build makes these strings from the
// files of the same names in this folder (embed.cmake).
#ifndef DIP_APP_REPORT_PAGE_WEB_EMBEDDED_H
#define DIP_APP_REPORT_PAGE_WEB_EMBEDDED_H

extern const unsigned char dip_cost_page_css[];
extern const unsigned char dip_cost_pictures_css[];
extern const unsigned char dip_cost_paper_css[];
extern const unsigned char dip_cost_tables_js[];
extern const unsigned char dip_cost_plots_js[];
extern const unsigned char dip_cost_viewer_js[];

#endif
