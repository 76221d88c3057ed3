/* SPDX-License-Identifier: GPL-3.0-or-later */
/* STUDY/fits.csv: a stamp in its first lines, then a line a number, and a seal. */
#include "analysis/data/output.h"
#include "analysis/fit/fits.h"
#include "base/file.h"
#include "campaigns/store/file/disk.h"

#include <errno.h>
#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { LINE = 1024, FIELDS = 10, MOST_MIB = 256 };
#define AGAIN "`fracas fit` makes it again"
static const char HEAD[] = "point,hash,family,quantity,unit,value,low,high,resamples,note\n";

/* The last line ends with the checksum of all bytes before it, 16 hexadecimal digits; one of the
 * first names it, or a file without its end would pass for an older one. */
static const char SEALED[] = ",,study,sealed,,,,,,by the checksum in the last line\n";
static const char SEAL[] = ",,study,seal,,,,,,";
enum { SEAL_LINE = sizeof SEAL - 1 + 16 + 1 };

static void put_real(double value, FILE *out)
{
    putc(',', out);
    if (isfinite(value)) fprintf(out, "%.17g", value);
}

void fracas_fits_put_row(const fracas_fits_row *row, FILE *out)
{
    fprintf(out, "%" PRId64 ",%s,%s,%s,%s", row->point, row->hash, row->family, row->quantity,
            row->unit);
    put_real(row->value, out);
    put_real(row->low, out);
    put_real(row->high, out);
    putc(',', out);
    if (row->resamples) fprintf(out, "%" PRId64, row->resamples);
    fprintf(out, ",%s\n", row->note);
}

static void write_all(const fracas_fits *fits, FILE *out)
{
    fputs(HEAD, out);
    fputs(SEALED, out);
    fprintf(out, ",,study,campaign,,,,,,%s\n", fits->campaign);
    fprintf(out, ",,study,realizations,1,%" PRId64 ",,,,it had then\n", fits->realizations);
    for (const fracas_fits_row *row = fits->row; row < fits->row + fits->n; row++)
        fracas_fits_put_row(row, out);
}

fracas_err fracas_fits_write(const fracas_fits *fits, const char *study)
{
    fracas_output_file output;
    OWNED char *path = NULL, *text = NULL;
    size_t size;
    FILE *memory = open_memstream(&text, &size);
    if (!memory) return fracas_no_memory("the fits of a study");
    write_all(fits, memory);
    if (fclose(memory)) return fracas_no_memory("the fits of a study");
    TRY(fracas_output_open(study, FRACAS_FITS_FILE, &output));
    fwrite(text, 1, size, output.file);
    fprintf(output.file, "%s%016" PRIx64 "\n", SEAL, fracas_checksum_of(text, size));
    fracas_err err = FRACAS_OK;
    if (fflush(output.file) || fsync(fileno(output.file)))
        err = fracas_fail_system(errno, "cannot write %s/" FRACAS_FITS_FILE, study);
    TRY(fracas_output_close(&output, err));
    TRY(fracas_disk_join(study, FRACAS_FITS_FILE, &path));
    return fracas_disk_sync_folder(path);
}

/* Splits a line at its commas, FIELDS of them exactly; takes the line feed away. */
static bool split(char *line, char *field[FIELDS])
{
    size_t n = 0;
    char *end = strchr(line, '\n');
    if (!end) return false;
    *end = '\0';
    for (char *rest = line; rest;) {
        char *one = strsep(&rest, ",");
        if (n == FIELDS) return false;
        field[n++] = one;
    }
    return n == FIELDS;
}

/* An empty field is NaN. */
static bool read_real(const char *text, double *value)
{
    char *end;
    *value = *text ? strtod(text, &end) : NAN;
    return !*text || (!*end && isfinite(*value));
}

static bool read_integer(const char *text, int64_t *value)
{
    char *end;
    errno = 0;
    *value = *text ? strtoll(text, &end, 10) : 0;
    return !*text || (!*end && !errno && *value >= 0);
}

static bool copy(const char *text, char *to, size_t size)
{
    return (size_t)snprintf(to, size, "%s", text) < size;
}

static bool read_stamp(char *const field[FIELDS], fracas_fits *fits)
{
    if (!strcmp(field[3], "campaign")) return copy(field[9], fits->campaign, sizeof fits->campaign);
    return strcmp(field[3], "realizations") != 0 || read_integer(field[5], &fits->realizations);
}

static bool read_row(char *const field[FIELDS], fracas_fits_row *row)
{
    return *field[0] && read_integer(field[0], &row->point) &&
           copy(field[1], row->hash, sizeof row->hash) &&
           copy(field[2], row->family, sizeof row->family) &&
           copy(field[3], row->quantity, sizeof row->quantity) &&
           copy(field[4], row->unit, sizeof row->unit) && read_real(field[5], &row->value) &&
           read_real(field[6], &row->low) && read_real(field[7], &row->high) &&
           read_integer(field[8], &row->resamples) && copy(field[9], row->note, sizeof row->note);
}

bool fracas_fits_take_row(char *line, fracas_fits_row *row)
{
    char *field[FIELDS];
    *row = (fracas_fits_row){0};
    return split(line, field) && read_row(field, row);
}

static fracas_err read_lines(FILE *in, const char *path, fracas_fits *fits)
{
    char line[LINE], *field[FIELDS];
    size_t number = 1;
    if (!fgets(line, sizeof line, in) || strcmp(line, HEAD) != 0)
        return fracas_fail(FRACAS_DAMAGED, "%s: line 1 is not that of a file of fits; " AGAIN,
                           path);
    for (; fgets(line, sizeof line, in); number++) {
        fracas_fits_row row = {0};
        const bool whole = split(line, field);
        if (!whole || !(*field[0] ? read_row(field, &row) : read_stamp(field, fits)))
            return fracas_fail(FRACAS_DAMAGED, "%s: line %zu is none of ours; " AGAIN, path,
                               number + 1);
        if (*field[0]) TRY(fracas_fits_append(fits, &row));
    }
    return ferror(in) ? fracas_fail_system(errno, "cannot read %s", path) : FRACAS_OK;
}

/* *text: all of the file with a final NUL, freed by the caller; NULL if there is none. */
static fracas_err load(const char *path, char **text, size_t *size)
{
    struct stat info;
    OWN_FD in = fracas_file_open(path);
    *text = NULL;
    if (in < 0 && errno == ENOENT) return FRACAS_OK;
    if (in < 0 || fstat(in, &info)) return fracas_fail_system(errno, "cannot read %s", path);
    if (info.st_size > (off_t)MOST_MIB << 20)
        return fracas_fail(FRACAS_DAMAGED, "%s has more than %d MiB, as no fits have; " AGAIN, path,
                           MOST_MIB);
    OWNED char *all = calloc((size_t)info.st_size + 1, 1);
    if (!all) return fracas_no_memory("the fits of a study");
    if (!fracas_disk_read(in, 0, all, (size_t)info.st_size, size))
        return fracas_fail_system(errno, "cannot read %s", path);
    *text = all;
    all = NULL;
    return FRACAS_OK;
}

/* The line of the seal, NULL if it is not the last. */
static const char *seal_of(const char *text, size_t size)
{
    const char *line = text + size - SEAL_LINE;
    return size >= SEAL_LINE && !strncmp(line, SEAL, sizeof SEAL - 1) ? line : NULL;
}

/* A file of an older version says nothing of a seal. */
static bool is_older(const char *text, size_t size)
{
    return !seal_of(text, size) && !strncmp(text, HEAD, sizeof HEAD - 1) && !strstr(text, SEALED);
}

static fracas_err check_seal(const char *path, const char *text, size_t size)
{
    char sum[18];
    const char *seal = seal_of(text, size);
    if (is_older(text, size))
        return fracas_fail(
            FRACAS_DAMAGED,
            "%s is of an older version of fracas, without a checksum: nothing can check it; " AGAIN,
            path);
    snprintf(sum, sizeof sum, "%016" PRIx64 "\n",
             seal ? fracas_checksum_of(text, (size_t)(seal - text)) : 0);
    if (seal && !strcmp(seal + sizeof SEAL - 1, sum)) return FRACAS_OK;
    return fracas_fail(FRACAS_DAMAGED,
                       "%s: damaged: its last line is not the checksum of those before it; " AGAIN,
                       path);
}

fracas_err fracas_fits_read(const char *study, fracas_fits **fits)
{
    OWNED char *path = NULL, *text = NULL;
    size_t size;
    *fits = NULL;
    TRY(fracas_disk_join(study, FRACAS_FITS_FILE, &path));
    TRY(load(path, &text, &size));
    if (!text) return FRACAS_OK;
    TRY(check_seal(path, text, size));
    OWN(FILE) in = fmemopen(text, size, "r");
    OWN(fracas_fits) found = calloc(1, sizeof *found);
    if (!in || !found) return fracas_no_memory("the fits of a study");
    TRY(read_lines(in, path, found));
    *fits = found;
    found = NULL;
    return FRACAS_OK;
}

bool fracas_fits_older(const char *study)
{
    OWNED char *path = NULL, *text = NULL;
    size_t size;
    return !fracas_disk_join(study, FRACAS_FITS_FILE, &path) && !load(path, &text, &size) && text &&
           is_older(text, size);
}

bool fracas_fits_foreign(const char *study)
{
    OWNED char *path = NULL, *text = NULL;
    struct stat info;
    size_t size;
    if (fracas_disk_join(study, FRACAS_FITS_FILE, &path) || lstat(path, &info) ||
        S_ISLNK(info.st_mode))
        return false;
    if (load(path, &text, &size)) return true; /* a folder, or larger than any of ours */
    return text && size > 0 && strncmp(text, HEAD, sizeof HEAD - 1) != 0 && !seal_of(text, size);
}
