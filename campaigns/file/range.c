/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "campaigns/file/range.h"

#include "base/elementary.h"
#include "campaigns/file/sweep.h"

#include <math.h>
#include <string.h>

static fracas_err read_end(const fracas_file *file, const fracas_leaf *leaf,
                           const fracas_node *node, const char *key, double *value)
{
    const fracas_node *end = fracas_node_find(node, key);
    if (!end)
        return fracas_file_error(
            file, node, "a range without `%s`; expected {from: ..., to: ..., points: ...}", key);
    fracas_setting setting;
    TRY(fracas_setting_read(file, leaf, end, &setting));
    *value = setting.value;
    return FRACAS_OK;
}

static fracas_err read_spacing(const fracas_file *file, const fracas_node *node,
                               fracas_range *range)
{
    const fracas_node *spacing = fracas_node_find(node, "spacing");
    if (!spacing) return FRACAS_OK;
    range->logarithmic = spacing->type == FRACAS_SCALAR && strcmp(spacing->text, "log") == 0;
    if (!range->logarithmic &&
        (spacing->type != FRACAS_SCALAR || strcmp(spacing->text, "lin") != 0))
        return fracas_file_expected(file, spacing, "spacing",
                                    "lin (equal differences) or log (equal ratios)");
    if (range->logarithmic && (range->from <= 0.0 || range->to <= 0.0))
        return fracas_file_error(
            file, spacing, "spacing log needs `from` and `to` greater than 0; use spacing lin");
    return FRACAS_OK;
}

fracas_err fracas_range_read(const fracas_file *file, const fracas_leaf *leaf,
                             const fracas_node *node, fracas_range *range)
{
    static const char *const keys[] = {"from", "to", "points", "spacing", NULL};
    *range = (fracas_range){0};
    if (fracas_leaf_is_text(leaf) || leaf->param->type == FRACAS_BOOLEAN)
        return fracas_file_error(file, node,
                                 "`%s` is not a number, so it has no range; expected a list, [...]",
                                 leaf->path);
    range->whole = leaf->param->type == FRACAS_INTEGER;
    TRY(fracas_file_check_keys(file, node, keys, "a range"));
    TRY(read_end(file, leaf, node, "from", &range->from));
    TRY(read_end(file, leaf, node, "to", &range->to));
    if (range->from == range->to)
        return fracas_file_error(
            file, node, "a range whose `from` and `to` are equal; write the one value in a list");
    const fracas_node *points = fracas_node_find(node, "points");
    int64_t count;
    if (!points)
        return fracas_file_error(
            file, node, "a range without `points`; expected {from: ..., to: ..., points: ...}");
    TRY(fracas_setting_integer(file, "points", points, 2, FRACAS_MAX_POINTS, &count));
    range->points = (size_t)count;
    return read_spacing(file, node, range);
}

double fracas_range_value(const fracas_range *range, size_t i)
{
    if (i == 0) return range->from;
    if (i == range->points - 1) return range->to;
    double part = (double)i / (double)(range->points - 1);
    double value = range->logarithmic
                       ? fracas_pow(range->from, 1.0 - part) * fracas_pow(range->to, part)
                       : range->from * (1.0 - part) + range->to * part;
    return range->whole ? floor(value + 0.5) : fracas_number_round(value);
}
