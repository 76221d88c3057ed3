/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Any bytes as a campaign file, with the files beside it that it may name (tests/fuzz/campaign.h).
 * The input: the campaign file, then, where a line "%%% strengths.csv" or "%%% mesh.msh" stands,
 * what those files hold. For libFuzzer (tools/fuzz), and the corpus as a test. */
#include "tests/fuzz/campaign.h"

static const char strengths[] = "# interface, strength\n0, 299e6\n1,3.01e8\n\n2\t300000000.5\r\n";
static const char *const beside[] = {"strengths.csv", "mesh.msh"};

/* Where the line "%%% NAME" stands; NULL if there is none. */
static const char *find_mark(const char *text, size_t size, const char *name, size_t *length)
{
    char mark[40];
    *length = (size_t)snprintf(mark, sizeof mark, "\n%%%%%% %s\n", name);
    return memmem(text, size, mark, *length);
}

/* The files of the input into the folder: each from its mark to the next. */
static void lay_out(const char *text, size_t size)
{
    size_t first = size;
    write_named(beside[0], strengths, sizeof strengths - 1);
    write_named("strengths.csv2", "3e8\n", 4);
    write_named(beside[1], "", 0);
    for (int f = 0; f < 2; f++) {
        size_t length, other;
        const char *mark = find_mark(text, size, beside[f], &length),
                   *next = find_mark(text, size, beside[1 - f], &other);
        if (!mark) continue;
        const char *end = next > mark ? next : text + size;
        write_named(beside[f], mark + length,
                    end > mark + length ? (size_t)(end - mark - length) : 0);
        if ((size_t)(mark - text) < first) first = (size_t)(mark - text);
    }
    write_named("c.yaml", text, first < size ? first + 1 : size);
}

/* ---- mild mutants ---- */

/* Of libFuzzer; replays of the corpus have none. */
size_t LLVMFuzzerMutate(uint8_t *data, size_t size, size_t most) __attribute__((weak));
size_t LLVMFuzzerCustomMutator(uint8_t *data, size_t size, size_t most, unsigned seed);

/* Bytes [*begin, *end) of number `which` of a text, counted round; false if it has none. */
static bool find_number(const uint8_t *data, size_t size, unsigned which, size_t *begin,
                        size_t *end)
{
    size_t count = 0;
    for (int round = 0; round < 2; round++) {
        size_t n = 0;
        for (size_t i = 0; i < size; i = *end) {
            *begin = i;
            *end = i + 1;
            if (data[i] < '0' || data[i] > '9' || (i > 0 && strchr(" ,[:-", data[i - 1]) == NULL))
                continue;
            while (*end < size && data[*end] && strchr("0123456789.e+-", data[*end])) ++*end;
            if (round == 1 && n == which % count) return true;
            n++;
        }
        count = n;
        if (count == 0) return false;
    }
    return false;
}

/* Two of three: another number in the place of one. */
size_t LLVMFuzzerCustomMutator(uint8_t *data, size_t size, size_t most, unsigned seed)
{
    static const char *const number[] = {"0",    "1",     "2",    "3",      "7",      "0.5",
                                         "0.1",  "1e-3",  "1e-9", "1e-30",  "1e3",    "1e9",
                                         "1e30", "1e300", "-1",   "1e-300", "1e-320", "10"};
    size_t begin, end;
    if (seed % 3 == 0 || !find_number(data, size, seed / 64, &begin, &end))
        return LLVMFuzzerMutate(data, size, most);
    const char *put = number[seed / 3 % FRACAS_COUNT(number)];
    const size_t length = strlen(put);
    if (size - (end - begin) + length > most) return size;
    memmove(data + begin + length, data + end, size - end);
    memcpy(data + begin, put, length);
    return size - (end - begin) + length;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    campaign_start();
    lay_out((const char *)data, size);
    check_campaign();
    return 0;
}
