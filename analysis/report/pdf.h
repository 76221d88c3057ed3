/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Drawings as PDF. */
#ifndef FRACAS_ANALYSIS_REPORT_PDF_H
#define FRACAS_ANALYSIS_REPORT_PDF_H

#include "analysis/report/page.h"

#include <stdbool.h>

/* False in a program built without librsvg: then there are no PDFs, and the page says nothing of
 * them. */
extern const bool fracas_pdf_made;

/* Every name[i].svg of the folder as name[i].pdf, vectors, one page of its size (96 pixels an
 * inch), without a date. Drawn by a child process, because the library ends its process when memory
 * is short, and keeps its allocations. FRACAS_ENVIRONMENT, naming the file, if it cannot. */
FRACAS_MUST_USE fracas_err fracas_pdf_write(const char *folder, char (*name)[FRACAS_DRAWING],
                                            size_t count);

#endif
