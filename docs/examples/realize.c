/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Computes realizations of a campaign with libfracas, and breaks one with strengths of its own.
 *
 *   cc -o realize realize.c $(pkg-config --cflags --libs fracas)
 *   ./realize FILE [POINT [REPLICAS]] */
#include <fracas.h>
#include <stdio.h>
#include <stdlib.h>

/* Prints number of fragments, end and mean size of a realization. */
static int print(const char *name, const fracas_realization *realization)
{
    double fragments, end;
    size_t column;
    if (fracas_realization_number(realization, "fragments", &fragments) ||
        fracas_realization_number(realization, "end_time", &end) ||
        fracas_table_find(FRACAS_TABLE_FRAGMENT, "size", &column))
        return 1;
    const size_t rows = fracas_realization_rows(realization, FRACAS_TABLE_FRAGMENT);
    double sum = 0, *size = malloc(rows * sizeof *size);
    int status = !size || fracas_realization_get(realization, FRACAS_TABLE_FRAGMENT, column, size,
                                                 rows * sizeof *size);
    for (size_t i = 0; i < rows && !status; i++) sum += size[i];
    free(size);
    if (!status)
        printf("%s\t%.0f fragments\tend %.17g s\tmean size %.17g m\n", name, fragments, end,
               sum / (double)rows);
    return status;
}

/* The strengths of replica 0, each 10 % lower. */
static int weaker(const fracas_realizer *realizer)
{
    const size_t n = fracas_realizer_strengths(realizer);
    const int64_t replica = 0;
    fracas_realization *realization = NULL;
    double *strength = malloc(n * sizeof *strength);
    int status = !strength || fracas_realizer_draw(realizer, replica, strength);
    for (size_t k = 0; k < n && !status; k++) strength[k] *= 0.9;
    status = status || fracas_realizer_compute(realizer, &replica, 1, strength, 0, &realization) ||
             print("weaker", realization);
    fracas_realization_close(realization);
    free(strength);
    return status;
}

static int compute(const fracas_campaign *campaign, size_t point, int64_t replicas)
{
    fracas_realizer *realizer = NULL;
    int status = fracas_realizer_open(campaign, point, &realizer);
    for (int64_t replica = 0; replica < replicas && !status; replica++) {
        char name[32];
        fracas_realization *realization = NULL;
        snprintf(name, sizeof name, "%lld", (long long)replica);
        status = fracas_realizer_compute(realizer, &replica, 1, NULL, 0, &realization) ||
                 print(name, realization);
        fracas_realization_close(realization);
    }
    status = status || weaker(realizer);
    fracas_realizer_close(realizer);
    return status;
}

int main(int argc, char **argv)
{
    fracas_campaign *campaign = NULL;
    if (argc < 2) return fprintf(stderr, "usage: realize FILE [POINT [REPLICAS]]\n"), 2;
    const size_t point = argc > 2 ? strtoul(argv[2], NULL, 10) : 0;
    const int64_t replicas = argc > 3 ? strtoll(argv[3], NULL, 10) : 1;
    int status = fracas_campaign_open(argv[1], &campaign) || compute(campaign, point, replicas);
    if (status) fprintf(stderr, "realize: %s\n", fracas_error());
    fracas_campaign_close(campaign);
    return status;
}
