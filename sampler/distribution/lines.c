/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "sampler/distribution/lines.h"

#include <math.h>

fracas_err fracas_lines_summarize(const fracas_attachment *file, fracas_lines_reader *read,
                                  fracas_lines_summary *summary)
{
    fracas_lines lines = fracas_lines_begin(file);
    *summary = (fracas_lines_summary){.smallest = INFINITY};
    for (;;) {
        bool found;
        double strength;
        TRY(read(&lines, &strength, &found));
        if (!found) break;
        const double before = summary->count > 0 ? strength - summary->sum / (double)summary->count
                                                 : 0.0;
        summary->count++;
        summary->sum += strength;
        summary->squares += before * (strength - summary->sum / (double)summary->count);
        summary->smallest = fmin(summary->smallest, strength);
        summary->largest = fmax(summary->largest, strength);
    }
    if (summary->count > 0) return FRACAS_OK;
    return fracas_fail(FRACAS_USAGE, "%s has no strength; expected one in Pa on each line",
                       file->path);
}
