/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Style sheets and script of a report: the files chart.css, page.css and page.js of this folder,
 * made part of the program by embed.cmake. */
#ifndef FRACAS_ANALYSIS_DRAW_ASSETS_H
#define FRACAS_ANALYSIS_DRAW_ASSETS_H

extern const char fracas_chart_style[]; /* for every drawing, on a page or in a file of its own:
                                           light. Colours of Okabe and Ito (2008) */
extern const char fracas_page_style[];  /* for the page; drawings in the dark, too */
extern const char fracas_page_script[];

#endif
