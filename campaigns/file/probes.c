/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "campaigns/file/probes.h"

#include <string.h>

static const char form[] = "names with places, as {tip: [9 mm, 0], middle: [0, 0]}";

static fracas_err read_name(const fracas_file *file, const fracas_node *key, char *name)
{
    static const char letters[] =
        "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-";
    const size_t length = strlen(key->text);
    if (length == 0 || length >= FRACAS_PROBE_NAME || key->text[strspn(key->text, letters)])
        return fracas_file_error(file, key,
                                 "`probes`: `%s` is no name of a probe: at most %d letters, "
                                 "digits, - and _",
                                 key->text, FRACAS_PROBE_NAME - 1);
    memcpy(name, key->text, length + 1);
    return FRACAS_OK;
}

static fracas_err read_place(const fracas_file *file, const fracas_node *entry, double place[3])
{
    static const char expected[] = "one to three lengths x, y, z, as [9 mm, 0]";
    size_t n = 0;
    if (entry->type != FRACAS_LIST || entry->count < 1 || entry->count > 3)
        return fracas_file_expected(file, entry, entry->key->text, expected);
    for (const fracas_node *one = entry->first; one; one = one->next) {
        if (one->type != FRACAS_SCALAR || !*one->text)
            return fracas_file_expected(file, one, entry->key->text, "a length, in m or mm");
        const fracas_err err = fracas_units_read(file->units, one->text, "m", &place[n++]);
        if (err)
            return err == FRACAS_USAGE ? fracas_file_error_within(file, one, entry->key->text)
                                       : err;
    }
    return FRACAS_OK;
}

fracas_err fracas_campaign_probes_read(const fracas_file *file, const fracas_node *node,
                                       fracas_probes *probes)
{
    if (node->type != FRACAS_MAP || !node->first)
        return fracas_file_expected(file, node, "probes", form);
    if (node->count > FRACAS_MOST_PROBES)
        return fracas_file_error(file, node, "`probes`: found %zu probes; at most %d are kept",
                                 node->count, FRACAS_MOST_PROBES);
    for (const fracas_node *entry = node->first; entry; entry = entry->next) {
        fracas_probe *probe = &probes->probe[probes->count++];
        TRY(read_name(file, entry->key, probe->name));
        TRY(read_place(file, entry, probe->place));
    }
    return FRACAS_OK;
}

void fracas_campaign_probes_write(const fracas_probes *probes, FILE *out)
{
    if (probes->count > 0) fprintf(out, "probes: # m\n");
    for (size_t p = 0; p < probes->count; p++) {
        const fracas_probe *probe = &probes->probe[p];
        fprintf(out, "  %s: [%.15g, %.15g, %.15g]\n", probe->name, probe->place[0], probe->place[1],
                probe->place[2]);
    }
}
