/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "base/sheet.h"

#include "base/terminal.h"
#include "base/text.h"

#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

static size_t width_of(const fracas_sheet *sheet, size_t column)
{
    size_t width = 0;
    for (size_t r = 0; r < sheet->rows; r++) {
        const size_t length = strlen(sheet->cell(sheet->of, r, column));
        width = length > width ? length : width;
    }
    return width;
}

static size_t room_of(const fracas_sheet *sheet, size_t column)
{
    return strlen(sheet->gap(sheet->of, column)) + width_of(sheet, column);
}

/* The columns of one table: the keys, and those from `first` to before `end`. */
typedef struct {
    size_t first, end;
    int columns;
} panel;

/* Prints a cell; false if nothing follows in its line. */
static bool print_cell(const fracas_sheet *sheet, const panel *of, size_t row, size_t column,
                       int *at, FILE *out)
{
    const char *cell = sheet->cell(sheet->of, row, column), *gap = sheet->gap(sheet->of, column);
    const bool to_left = sheet->left >> column & 1, last = column + 1 == of->end;
    const int width = (int)width_of(sheet, column), before = *at + (int)strlen(gap);
    if (last && to_left && !*cell) return true;
    fputs(gap, out);
    *at = before + width;
    if (last && to_left && of->columns && before + (int)strlen(cell) >= of->columns) {
        fracas_text_wrap(cell, before, of->columns, out);
        return false;
    }
    fprintf(out, to_left ? "%-*s" : "%*s", last && to_left ? 0 : width, cell);
    return true;
}

static void print_panel(const fracas_sheet *sheet, const panel *of, FILE *out)
{
    for (size_t r = 0; r < sheet->rows; r++) {
        int at = (int)strlen(sheet->indent);
        bool open = true;
        fputs(sheet->indent, out);
        for (size_t c = 0; c < of->end && open; c++)
            if (c < sheet->keys || c >= of->first) open = print_cell(sheet, of, r, c, &at, out);
        if (open) putc('\n', out);
    }
}

void fracas_sheet_print(const fracas_sheet *sheet, int columns, FILE *out)
{
    size_t keys = strlen(sheet->indent);
    for (size_t c = 0; c < sheet->keys; c++) keys += room_of(sheet, c);
    size_t first = sheet->keys < sheet->columns ? sheet->keys : 0;
    for (size_t end; first < sheet->columns; first = end) {
        size_t used = keys;
        for (end = first; end < sheet->columns; end++) {
            used += room_of(sheet, end);
            if (columns && end > first && used >= (size_t)columns) break;
        }
        print_panel(sheet, &(panel){first, end, columns}, out);
        if (end < sheet->columns) putc('\n', out);
    }
}

void fracas_sheet_legend(const char *const *line, int columns, FILE *out)
{
    char *text = NULL;
    size_t size;
    FILE *whole = columns ? open_memstream(&text, &size) : NULL;
    for (; *line; line++) fprintf(whole ? whole : out, "%s%c", *line, whole ? ' ' : '\n');
    if (!whole) return;
    if (!fclose(whole)) fracas_text_wrap(text, 0, columns, out);
    free(text);
}

void fracas_sheet_warning(const char *text, int columns, FILE *out)
{
    static const char word[] = "warning: ";
    const bool painted = columns && out == stdout;
    if (painted) fracas_paint(FRACAS_YELLOW);
    fputs(word, out);
    if (painted) fracas_paint(FRACAS_PLAIN);
    fracas_text_wrap(text, (int)strlen(word), columns, out);
}
