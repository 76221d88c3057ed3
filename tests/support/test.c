/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Definitions of tests/support/test.h for every program of tests. */
#include "tests/support/test.h"

void test_fails(const char *call, fracas_err err, fracas_err wanted, const char *const part[],
                size_t most)
{
    if (err != wanted) fail_msg("%s: code %d, not %d: %s", call, err, wanted, fracas_message());
    for (size_t p = 0; p < most && part[p]; p++) assert_has(fracas_message(), part[p]);
}

void assert_close(double got, double expected, double relative)
{
    if (!(fabs(got - expected) <= relative * fabs(expected)))
        fail_msg("%.17g is not %.17g to %g relative", got, expected, relative);
}

void assert_has(const char *text, const char *part)
{
    if (!strstr(text, part)) fail_msg("no \"%s\" in: %s", part, text);
}

static char *stream_text;
static size_t stream_size;

FILE *text_begin(void)
{
    FILE *out = open_memstream(&stream_text, &stream_size);
    assert_non_null(out);
    return out;
}

char *text_end(FILE *out)
{
    assert_int_equal(fclose(out), 0);
    return stream_text;
}

char *whole_file(const char *path)
{
    size_t size;
    return (char *)whole_bytes(path, &size);
}

unsigned char *whole_bytes(const char *path, size_t *size)
{
    FILE *in = fopen(path, "rb");
    if (!in) fail_msg("cannot open %s", path);
    fseek(in, 0, SEEK_END);
    *size = (size_t)ftell(in);
    rewind(in);
    unsigned char *bytes = taken(*size + 1);
    assert_int_equal(fread(bytes, 1, *size, in), *size);
    bytes[*size] = '\0';
    fclose(in);
    return bytes;
}

void write_bytes(const char *path, const void *bytes, size_t size)
{
    FILE *out = fopen(path, "wb");
    assert_non_null(out);
    assert_int_equal(fwrite(bytes, 1, size, out), size);
    assert_int_equal(fclose(out), 0);
}
