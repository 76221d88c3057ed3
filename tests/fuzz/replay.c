/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Every file of the folders and files named in the arguments as an input of the fuzz target that
 * this is linked with: the corpus as a test, without libFuzzer. Says how many there were; none is a
 * failure. */
#include "tests/fuzz/fuzz.h"

#include <dirent.h>
#include <sys/stat.h>

static size_t replay_file(const char *path)
{
    FILE *in = fopen(path, "rb");
    struct stat info;
    FUZZ_DEMAND(in && fstat(fileno(in), &info) == 0, path);
    size_t size = (size_t)info.st_size;
    uint8_t *bytes = malloc(size ? size : 1); /* no byte more, for a sanitizer to see */
    FUZZ_DEMAND(bytes && fread(bytes, 1, size, in) == size, path);
    fclose(in);
    LLVMFuzzerTestOneInput(bytes, size);
    free(bytes);
    return 1;
}

static int no_dots(const struct dirent *entry)
{
    return entry->d_name[0] != '.';
}

static size_t replay(const char *path)
{
    struct stat info;
    struct dirent **entry;
    FUZZ_DEMAND(stat(path, &info) == 0, path);
    if (!S_ISDIR(info.st_mode)) return replay_file(path);
    int count = scandir(path, &entry, no_dots, alphasort);
    size_t done = 0;
    for (int e = 0; e < count; e++) {
        char inner[4096];
        snprintf(inner, sizeof inner, "%s/%s", path, entry[e]->d_name);
        done += replay(inner);
        free(entry[e]);
    }
    if (count >= 0) free(entry);
    return done;
}

int main(int argc, char **argv)
{
    size_t done = 0;
    for (int a = 1; a < argc; a++) done += replay(argv[a]);
    printf("%zu inputs\n", done);
    return done > 0 ? 0 : 1;
}
