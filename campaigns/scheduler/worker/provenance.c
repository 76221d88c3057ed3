/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "campaigns/scheduler/worker/provenance.h"

#include "base/json.h"
#include "base/version.h"
#include "campaigns/store/store.h"

#include <mpi.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#ifdef __clang__
static const char compiler[] = __VERSION__; /* names itself */
#else
static const char compiler[] = "gcc " __VERSION__;
#endif

static void read_cpu(char *model, size_t size)
{
    snprintf(model, size, "unknown");
    OWN(FILE) file = fopen("/proc/cpuinfo", "r");
    char line[256];
    while (file && fgets(line, sizeof line, file)) {
        const char *value = strchr(line, ':');
        if (strncmp(line, "model name", 10) || !value) continue;
        line[strcspn(line, "\n")] = '\0';
        snprintf(model, size, "%s", value + 1 + strspn(value + 1, " "));
        return;
    }
}

/* "Open MPI v4.1.4": MPI allows this call before MPI_Init, hence in a compute server. */
static void read_mpi(char *version, size_t size)
{
    char text[MPI_MAX_LIBRARY_VERSION_STRING] = "unknown";
    int length;
    if (MPI_Get_library_version(text, &length) != MPI_SUCCESS) strcpy(text, "unknown");
    snprintf(version, size, "%.*s", (int)strcspn(text, ",\n"), text);
}

static void write_versions(fracas_json *json)
{
    char cpu[256], hdf5[32], mpi[128];
    read_cpu(cpu, sizeof cpu);
    fracas_hdf5_version(hdf5);
    read_mpi(mpi, sizeof mpi);
    fracas_json_text(json, "version", FRACAS_VERSION);
    fracas_json_text(json, "compiler", compiler);
    fracas_json_text(json, "hdf5", hdf5);
    fracas_json_text(json, "sqlite", fracas_sqlite_version());
    fracas_json_text(json, "mpi", mpi);
    fracas_json_text(json, "cpu", cpu);
}

fracas_err fracas_provenance_make(const fracas_provenance *provenance,
                                  const fracas_run_options *options, char **text)
{
    fracas_isa isa; /* for this server's batches */
    size_t size;
    TRY(fracas_isa_choose(options->isa, &isa));
    FILE *out = open_memstream(text, &size);
    if (!out) return fracas_no_memory("the provenance of a segment");
    const char *job = getenv("SLURM_JOB_ID");
    fracas_json json;
    fracas_json_begin(&json, out);
    fracas_json_text(&json, "host", provenance->host);
    fracas_json_integer(&json, "pid", getpid());
    if (job) fracas_json_text(&json, "slurm_job", job);
    write_versions(&json);
    fracas_json_text(&json, "isa", fracas_isa_name[isa]);
    fracas_json_integer(&json, "lanes_asked",
                        options->width); /* 0: by the number of realizations */
    fracas_json_real(&json, "began",
                     (double)provenance->began.tv_sec + 1e-9 * (double)provenance->began.tv_nsec);
    fracas_json_real(&json, "wall_seconds", provenance->wall);
    fracas_json_real(&json, "compute_seconds", provenance->compute);
    fracas_json_end(&json);
    if (fclose(out) || !*text) return fracas_no_memory("the provenance of a segment");
    return FRACAS_OK;
}
