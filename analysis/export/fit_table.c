/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The table of fits. */
#include "analysis/export/side_tables.h"

#include "analysis/data/format.h"

#include <math.h>

const char *const fracas_fit_table_legend[] = {
    "\u0394AICc: above that of the best family; of families within some 4 of each other the data "
    "prefer none, but for what is said below the table.",
    "KS, AD: distance of the fragments from the family, Kolmogorov and Smirnov\u2019s and Anderson "
    "and Darling\u2019s; p: how often data of the",
    "fitted law are as far from their own fit, by resampling realizations: below 0.05 the family "
    "does not describe the sizes.",
    "Parameters with 95 % intervals that resample realizations, lengths over the mean of the sizes "
    "above the cut. Intervals and p hold from 50 realizations on.",
    NULL,
};

static size_t count_ranked(const fracas_analysis *analysis, const fracas_fits *fits)
{
    size_t count = 0;
    for (size_t p = 0; p < analysis->table->npoints; p++)
        for (int rank = 1; rank <= FRACAS_NFAMILIES; rank++)
            count += fracas_fits_ranked(fits, (int64_t)p, rank) != NULL;
    return count;
}

static void put_number(const fracas_fits *fits, int64_t point, const char *family,
                       const char *quantity, int digits, char *cell)
{
    const fracas_fits_row *row = fracas_fits_find(fits, point, family, quantity);
    fracas_format_digits(row ? row->value : NAN, digits, cell, FRACAS_CELL);
}

fracas_err fracas_fit_table_create(const fracas_analysis *analysis, const fracas_fits *fits,
                                   bool unicode, fracas_result_table *table)
{
    enum { RANK, DELTA, KS, KS_P, AD, AD_P, FAMILY, PARAMETERS, NCOLUMNS };
    const char *const name[NCOLUMNS] = {
        "rank", unicode ? "\u0394AICc" : "d AICc", "KS", "p", "AD", "p", "family", "parameters"};
    TRY(fracas_table_empty(count_ranked(analysis, fits), NCOLUMNS, name, table));
    size_t line = FRACAS_RESULT_TABLE_HEAD;
    for (size_t p = 0; p < analysis->table->npoints; p++) {
        for (int rank = 1; rank <= FRACAS_NFAMILIES; rank++) {
            const char *family = fracas_fits_ranked(fits, (int64_t)p, rank);
            if (!family || !fracas_family_find(family)) continue;
            char *cell[NCOLUMNS];
            for (size_t c = 0; c < NCOLUMNS; c++)
                cell[c] = fracas_result_table_cell(table, line, c);
            const fracas_label label = fracas_analysis_label(analysis, p);
            const fracas_fits_row *delta = fracas_fits_find(fits, (int64_t)p, family, "delta_aicc");
            snprintf(cell[RANK], FRACAS_CELL, "%d", rank);
            if (delta) snprintf(cell[DELTA], FRACAS_CELL, "%.1f", delta->value);
            put_number(fits, (int64_t)p, family, "ks", 3, cell[KS]);
            fracas_fits_format_p(fracas_fits_find(fits, (int64_t)p, family, "ks_p"), cell[KS_P],
                                 FRACAS_CELL);
            put_number(fits, (int64_t)p, family, "ad", 3, cell[AD]);
            fracas_fits_format_p(fracas_fits_find(fits, (int64_t)p, family, "ad_p"), cell[AD_P],
                                 FRACAS_CELL);
            snprintf(cell[FAMILY], FRACAS_CELL, "%.79s%s%s", label.text, *label.text ? ": " : "",
                     family);
            fracas_fits_format_parameters(fits, (int64_t)p, fracas_family_find(family),
                                          cell[PARAMETERS], FRACAS_CELL);
            line++;
        }
    }
    return FRACAS_OK;
}
