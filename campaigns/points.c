#include "campaigns/points.h"

#include <string.h>

size_t fracas_point_table_find(const fracas_point_table *table, const char *path)
{
    for (size_t c = 0; c < table->ncolumns; c++)
        if (strcmp(table->column[c].path, path) == 0) return c;
    return SIZE_MAX;
}
