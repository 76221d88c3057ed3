/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "base/param.h"

static const void *place(const fracas_param *param, const void *section)
{
    return (const char *)section + param->offset;
}

static const fracas_kind *chosen(const fracas_param *param, const void *section)
{
    return *(const fracas_kind *const *)place(param, section);
}

static double index_of(const fracas_param *param, const fracas_kind *choice)
{
    for (size_t c = 0; c < param->nchoices; c++)
        if (param->choices[c] == choice) return (double)c;
    return NAN;
}

double fracas_param_get(const fracas_param *param, const void *section)
{
    switch (param->type) {
    case FRACAS_INTEGER: return (double)*(const int64_t *)place(param, section);
    case FRACAS_BOOLEAN: return *(const bool *)place(param, section) ? 1.0 : 0.0;
    case FRACAS_CHOICE: return index_of(param, chosen(param, section));
    case FRACAS_ATTACHMENT:
    case FRACAS_NUMBERS: return NAN;
    case FRACAS_REAL: break;
    }
    return *(const double *)place(param, section);
}

void fracas_param_set(const fracas_param *param, void *section, double value)
{
    void *at = (char *)section + param->offset;
    switch (param->type) {
    case FRACAS_INTEGER: *(int64_t *)at = (int64_t)value; break;
    case FRACAS_BOOLEAN: *(bool *)at = value != 0.0; break;
    case FRACAS_CHOICE: *(const fracas_kind **)at = param->choices[(size_t)value]; break;
    case FRACAS_ATTACHMENT:
    case FRACAS_NUMBERS: break;
    case FRACAS_REAL: *(double *)at = value; break;
    }
}

void fracas_param_clear(const fracas_param *param, void *section)
{
    void *at = (char *)section + param->offset;
    if (param->type == FRACAS_REAL) *(double *)at = NAN;
    else if (param->type == FRACAS_CHOICE) *(const fracas_kind **)at = NULL;
    else if (fracas_param_is_object(param)) fracas_param_place(param, section, NULL);
}

bool fracas_param_is_given(const fracas_param *param, const void *section)
{
    if (!param->optional) return true;
    if (fracas_param_is_object(param)) return fracas_param_object(param, section) != NULL;
    return !isnan(fracas_param_get(param, section));
}

const void *fracas_param_object(const fracas_param *param, const void *section)
{
    return *(const void *const *)place(param, section);
}

void fracas_param_place(const fracas_param *param, void *section, const void *object)
{
    *(const void **)(void *)((char *)section + param->offset) = object;
}

const char *fracas_param_text(const fracas_param *param, const void *section)
{
    if (param->type == FRACAS_CHOICE && chosen(param, section)) return chosen(param, section)->name;
    const fracas_attachment *attachment = param->type == FRACAS_ATTACHMENT
                                              ? fracas_param_object(param, section)
                                              : NULL;
    return attachment ? attachment->digest : "";
}

bool fracas_param_is_of(const fracas_param *param, const fracas_kind *model)
{
    return !param->only || (model && param->only & model->groups);
}

fracas_err fracas_param_check_either(const char *takes, const char *const key[2],
                                     const double value[2], const char *example)
{
    const bool first = fabs(value[0]) > 0, second = fabs(value[1]) > 0, both = first && second;
    if (first != second) return FRACAS_OK;
    return fracas_fail(FRACAS_USAGE, "%s either %s or %s, and %s given: %s%s%s", takes, key[0],
                       key[1], both ? "both are" : "neither is",
                       both ? "leave one out, or set it to 0 where a sweep would inherit it"
                            : "add one, for instance `",
                       both ? "" : example, both ? "" : "`");
}

const fracas_kind *fracas_kind_partner(const fracas_kind *kind, const fracas_section *section,
                                       size_t i)
{
    for (size_t g = 0; g < kind->ngoes_with; g++)
        for (size_t k = 0; k < section->nkinds; k++)
            if (section->kinds[k] == kind->goes_with[g] && i-- == 0) return section->kinds[k];
    for (size_t k = 0; k < section->nkinds; k++)
        if (section->kinds[k]->only & kind->groups && i-- == 0) return section->kinds[k];
    return NULL;
}
