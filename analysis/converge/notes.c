/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Notes of a convergence on its realizations. */
#include "analysis/converge/rows.h"

#include <inttypes.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

static fracas_err add_note(fracas_convergence *convergence, const char *refinement, size_t point,
                           fracas_convergence_note **note)
{
    if (convergence->nnotes == convergence->note_room) {
        const size_t room = 2 * convergence->note_room + 8;
        fracas_convergence_note *more = realloc(convergence->note, room * sizeof *more);
        if (!more) return fracas_no_memory("the notes of the convergence");
        convergence->note = more;
        convergence->note_room = room;
    }
    *note = &convergence->note[convergence->nnotes++];
    (*note)->refinement = refinement;
    (*note)->point = point;
    return FRACAS_OK;
}

/* "7 of 10 realizations ended ENERGY_DRIFT, 1 NONFINITE: judged from 2" */
static void write_lost(const fracas_point_statistics *of, size_t judged, char *text, size_t size)
{
    char first[64];
    FRACAS_PRINT(first, " of %" PRId64 " realizations ended", of->realizations);
    *text = '\0';
    for (int o = FRACAS_NONFINITE; o <= FRACAS_FAILED; o++)
        if (of->outcome[o] > 0)
            fracas_append(text, size, ", ", "%" PRId64 "%s %s", of->outcome[o], *text ? "" : first,
                          fracas_outcome_name(o));
    if (judged > 0) fracas_append(text, size, "", ": judged from %zu", judged);
    else fracas_append(text, size, "", ": none is left, its numbers are unknown");
}

fracas_err fracas_convergence_note_point(fracas_convergence *convergence, const char *refinement,
                                         size_t point, const fracas_point_statistics *of,
                                         size_t judged)
{
    fracas_convergence_note *note;
    if (of->usable < of->realizations) {
        TRY(add_note(convergence, refinement, point, &note));
        write_lost(of, judged, note->text, sizeof note->text);
    }
    if (of->usable == 0 || of->outcome[FRACAS_INTACT] != of->usable) return FRACAS_OK;
    TRY(add_note(convergence, refinement, point, &note));
    FRACAS_PRINT(
        note->text,
        "all %" PRId64
        " usable realizations end INTACT: nothing breaks, and nothing is judged of how it breaks",
        of->usable);
    return FRACAS_OK;
}

fracas_err fracas_convergence_note_study(fracas_convergence *convergence, const char *refinement,
                                         const fracas_analysis *analysis, const char *study)
{
    fracas_convergence_note *note;
    fracas_warning *warning;
    size_t count;
    TRY(fracas_analysis_warnings(analysis, &warning, &count));
    free(warning);
    if (count == 0) return FRACAS_OK;
    TRY(add_note(convergence, refinement, SIZE_MAX, &note));
    FRACAS_PRINT(note->text, "its report has %zu warning%s: fracas report %s", count,
                 count == 1 ? "" : "s", study);
    return FRACAS_OK;
}

void fracas_convergence_note_line(const fracas_convergence *convergence,
                                  const fracas_convergence_note *note, char *text, size_t size)
{
    const fracas_label label = fracas_analysis_label(convergence->study, note->point);
    snprintf(text, size, "%s%s%s: %s", note->refinement, *label.text ? ", " : "", label.text,
             note->text);
}
