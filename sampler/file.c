/* Strengths that are given, not drawn: a line of a file for each interface. */
#include "sampler/distribution.h"

#include "base/units.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>

enum { FIELD = 64 }; /* bytes of a field, its end included: more than any number of use */

/* A walk through the lines of a file. */
typedef struct {
    const fracas_attachment *file;
    const char *at, *end;
    int64_t line;   /* of the field that was found last, from 1 */
    bool begun;     /* a line that is no remark has been seen: it may have been the header */
    char field[FIELD]; /* "" if there is none, or if it holds what no text has */
} walk;

static walk walk_begin(const fracas_attachment *file)
{
    static const char mark[] = "\xef\xbb\xbf"; /* some programs put it before UTF-8 */
    const size_t skip = strncmp(file->text, mark, 3) == 0 ? 3 : 0;
    return (walk){.file = file, .at = file->text + skip, .end = file->text + file->size};
}

static bool is_blank(char c)
{
    return c == ' ' || c == '\t' || c == '\r';
}

/* The last field of the next line that is neither empty nor a remark; false at the end of the file. */
static bool next_field(walk *w)
{
    while (w->at < w->end) {
        const char *start = w->at, *stop = memchr(start, '\n', (size_t)(w->end - start));
        if (!stop) stop = w->end;
        w->at = stop < w->end ? stop + 1 : stop;
        w->line++;
        while (start < stop && is_blank(*start)) start++;
        while (start < stop && is_blank(stop[-1])) stop--;
        if (start == stop || *start == '#') continue;
        const char *field = stop;
        while (field > start && field[-1] != ',' && !is_blank(field[-1])) field--;
        const size_t length = (size_t)(stop - field), kept = length < FIELD ? length : FIELD - 1;
        memcpy(w->field, field, kept);
        w->field[kept] = '\0';
        if (strlen(w->field) != kept) w->field[0] = '\0';
        return true;
    }
    return false;
}

/* A line of headings ends with a word. A number with a slip in it is none, nor are the numbers that C calls by words. */
static bool is_heading(const char *field)
{
    static const char *const words[] = {"nan", "inf", "infinity"};
    for (size_t w = 0; w < FRACAS_COUNT(words); w++)
        if (strcasecmp(field, words[w]) == 0) return false;
    return *field && !strchr("0123456789+-.", *field);
}

/* The next strength; *found is false at the end of the file. */
FRACAS_MUST_USE static fracas_err next_strength(walk *w, double *value, bool *found)
{
    bool first = !w->begun;
    *found = next_field(w);
    w->begun = true;
    if (*found && first && is_heading(w->field)) *found = next_field(w);
    if (!*found || (!fracas_number_read(w->field, value) && *value > 0.0)) return FRACAS_OK;
    return fracas_fail(FRACAS_USAGE, "%s:%" PRId64 ": found %s%s%s; expected a strength in Pa, a number greater than 0 at the end of "
                                     "the line, after a comma or a blank if it is not alone, without a unit", w->file->path, w->line,
                       *w->field ? "`" : "no text there", w->field, *w->field ? "`" : "");
}

/* What is known of a file once it is read. */
typedef struct {
    size_t count;
    double sum, smallest, largest; /* Pa */
} summary;

FRACAS_MUST_USE static fracas_err summarize(const fracas_attachment *file, summary *of)
{
    walk w = walk_begin(file);
    bool found;
    double value;
    *of = (summary){.smallest = INFINITY};
    for (;;) {
        TRY(next_strength(&w, &value, &found));
        if (!found) return FRACAS_OK;
        of->count++;
        of->sum += value;
        of->smallest = fmin(of->smallest, value);
        of->largest = fmax(of->largest, value);
    }
}

/* The file was checked when the campaign was read. */
static summary summary_of(const fracas_strength *strength)
{
    summary of;
    return summarize(strength->file, &of) ? (summary){.sum = NAN} : of;
}

FRACAS_MUST_USE static fracas_err file_check(const fracas_strength *strength)
{
    summary of;
    TRY(summarize(strength->file, &of));
    if (of.count > 0) return FRACAS_OK;
    return fracas_fail(FRACAS_USAGE, "%s has no strength; expected one in Pa on each line", strength->file->path);
}

static double file_quantile(const fracas_strength *strength, double volume, double u)
{
    (void)volume;
    const summary of = summary_of(strength);
    return u < 0.5 ? of.smallest : of.largest;
}

static double file_mean(const fracas_strength *strength, double volume)
{
    (void)volume;
    const summary of = summary_of(strength);
    return of.sum / (double)of.count;
}

static size_t file_count(const fracas_strength *strength)
{
    return summary_of(strength).count;
}

static void file_fill(const fracas_strength *strength, size_t n, size_t stride, double *sigma_c)
{
    walk w = walk_begin(strength->file);
    bool found = true;
    for (size_t i = 0; i < n; i++)
        if (!found || next_strength(&w, &sigma_c[i * stride], &found) || !found) sigma_c[i * stride] = NAN;
}

static const fracas_param params[] = {
    {.name = "file", .type = FRACAS_ATTACHMENT, .unit = "1",
     .doc = "text with a strength in Pa at the end of each line, for one interface after the other; headings in the first line, "
            "empty lines and lines that start with # are skipped",
     .fallback = FRACAS_REQUIRED, .offset = offsetof(fracas_strength, file)},
};
const fracas_distribution fracas_file_distribution = {
    .kind = {.name = "file", .doc = "strengths of all interfaces from a file, the same for every replica", .params = params,
             .nparams = FRACAS_COUNT(params)},
    .quantile = file_quantile, .mean = file_mean, .check = file_check, .count = file_count, .fill = file_fill,
};
