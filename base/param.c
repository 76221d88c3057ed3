#include "base/param.h"

double fracas_param_get(const fracas_param *param, const void *section)
{
    const char *at = (const char *)section + param->offset;
    switch (param->type) {
    case FRACAS_INTEGER: return (double)*(const int64_t *)(const void *)at;
    case FRACAS_BOOLEAN: return *(const bool *)(const void *)at ? 1.0 : 0.0;
    case FRACAS_REAL: case FRACAS_CHOICE: case FRACAS_ATTACHMENT: break;
    }
    return *(const double *)(const void *)at;
}

void fracas_param_set(const fracas_param *param, void *section, double value)
{
    char *at = (char *)section + param->offset;
    switch (param->type) {
    case FRACAS_INTEGER: *(int64_t *)(void *)at = (int64_t)value; break;
    case FRACAS_BOOLEAN: *(bool *)(void *)at = value != 0.0; break;
    case FRACAS_CHOICE: case FRACAS_ATTACHMENT: break;
    case FRACAS_REAL: *(double *)(void *)at = value; break;
    }
}
