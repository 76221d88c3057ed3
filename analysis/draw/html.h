/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The frame of a page: its head, its style and its own script. */
#ifndef FRACAS_ANALYSIS_DRAW_HTML_H
#define FRACAS_ANALYSIS_DRAW_HTML_H

#include "base/err.h"

#include <stdio.h>

/* From <!DOCTYPE html> to the line below the title. The page loads nothing and runs `script` alone,
 * whatever its texts may hold. refresh: it loads itself again after so many s; 0: never. */
FRACAS_MUST_USE fracas_err fracas_html_begin(const char *title, const char *lead,
                                             const char *script, int refresh, FILE *out);
/* After </main>. */
void fracas_html_end(const char *script, FILE *out);

/* A page of one body: FILE of the folder, whole or not at all. */
FRACAS_MUST_USE fracas_err fracas_html_alone(const char *folder, const char *file,
                                             const char *title, const char *lead, const char *body,
                                             const char *script);

#endif
