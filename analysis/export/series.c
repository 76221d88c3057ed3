#include "analysis/export/csv.h"

#include <inttypes.h>

void fracas_csv_energies(const fracas_analysis *analysis, FILE *out)
{
    static const char *const name[FRACAS_NENERGIES] = {"kinetic", "elastic", "cohesive", "dissipated"};
    fputs("point,time,running,realizations", out);
    for (int e = 0; e < FRACAS_NENERGIES; e++) fprintf(out, ",%s.mean,%s.low,%s.high", name[e], name[e], name[e]);
    putc('\n', out);
    for (size_t p = 0; p < analysis->table->npoints; p++) {
        const fracas_bands *bands = &analysis->point[p].bands;
        for (size_t j = 0; j < bands->count; j++) {
            fprintf(out, "%zu", p);
            fracas_csv_real(bands->time[j], out);
            fprintf(out, ",%" PRId64 ",%" PRId64, bands->running[j], bands->realizations);
            for (int e = 0; e < FRACAS_NENERGIES; e++) {
                fracas_csv_real(bands->energy[j][e].mean, out);
                fracas_csv_real(bands->energy[j][e].low, out);
                fracas_csv_real(bands->energy[j][e].high, out);
            }
            putc('\n', out);
        }
    }
}

void fracas_csv_convergence(const fracas_analysis *analysis, FILE *out)
{
    fputs("point,replicas", out);
    for (int h = 0; h < FRACAS_NHEADLINES; h++)
        fprintf(out, ",%s.value,%s.low,%s.high", fracas_headline_key[h], fracas_headline_key[h], fracas_headline_key[h]);
    putc('\n', out);
    for (size_t p = 0; p < analysis->table->npoints; p++) {
        const fracas_convergence *of = &analysis->point[p].convergence;
        for (const fracas_running *row = of->row; row < of->row + of->count; row++) {
            fprintf(out, "%zu,%" PRId64, p, row->replicas);
            for (int h = 0; h < FRACAS_NHEADLINES; h++) {
                fracas_csv_real(row->number[h].value, out);
                fracas_csv_real(row->number[h].low, out);
                fracas_csv_real(row->number[h].high, out);
            }
            putc('\n', out);
        }
    }
}
