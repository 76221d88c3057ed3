/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Files by name: anything else is refused at once, and nothing is written through a link. */
#include "base/file.h"

#include "base/own.h"

#define FOLDER "fracas-file"
#include "tests/support/folder.h"

#include <errno.h>
#include <fcntl.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

static const char text[] = "precious\n";

static void write_victim(void)
{
    OWN(FILE) out = fopen("victim", "w");
    assert_non_null(out);
    fputs(text, out);
}

static void check_victim(void)
{
    char found[32] = "";
    OWN(FILE) in = fopen("victim", "r");
    assert_non_null(in);
    assert_true(fread(found, 1, sizeof found - 1, in) > 0);
    assert_string_equal(found, text);
}

static void make_socket(const char *path)
{
    struct sockaddr_un name = {.sun_family = AF_UNIX};
    OWN_FD fd = socket(AF_UNIX, SOCK_STREAM, 0);
    assert_true(fd >= 0 && strlen(path) < sizeof name.sun_path);
    strcpy(name.sun_path, path);
    assert_int_equal(bind(fd, (struct sockaddr *)&name, sizeof name), 0);
}

/* Opening `path` by each function fails with these reasons, 0: it opens. */
static void expect(const char *path, int reading, int writing)
{
    OWN_FD in = fracas_file_open(path);
    assert_int_equal(in < 0 ? errno : 0, reading);
    OWN_FD out = fracas_file_open_own(path);
    assert_int_equal(out < 0 ? errno : 0, writing);
    assert_int_equal(fracas_file_is_own(path) ? 0 : errno, writing);
}

static void no_file_is_refused_at_once(void **state)
{
    write_victim();
    expect("victim", 0, 0);
    assert_int_equal(symlink("victim", "link"), 0);
    expect("link", 0, ELOOP); /* read through a link, never written */
    assert_int_equal(mkfifo("pipe", 0600), 0);
    expect("pipe", ENXIO, ENXIO);
    make_socket("socket");
    expect("socket", ENXIO, ENXIO);
    expect("/dev/null", ENXIO, ENXIO);
    assert_int_equal(symlink("pipe", "link-to-pipe"), 0);
    expect("link-to-pipe", ENXIO, ELOOP);
    assert_int_equal(fracas_file_open("none"), -1);
    assert_int_equal(errno, ENOENT);
    assert_int_equal(fracas_file_open("."), -1);
    assert_int_equal(errno, EISDIR);
    assert_null(fracas_file_stream(-1, "r"));
    check_victim();
}

static void a_new_file_takes_the_place_of_a_link(void **state)
{
    struct stat info;
    write_victim();
    assert_int_equal(symlink("victim", "new"), 0);
    OWN(FILE) out = fracas_file_stream(fracas_file_create("new"), "w");
    assert_non_null(out);
    fputs("new", out);
    assert_int_equal(fflush(out), 0);
    assert_int_equal(lstat("new", &info), 0);
    assert_true(S_ISREG(info.st_mode) && info.st_size == 3);
    check_victim();
    assert_int_equal(fracas_file_create("."), -1); /* a folder stays */
}

static void folders_are_no_links(void **state)
{
    assert_true(fracas_folder_create("folder"));
    assert_true(fracas_folder_create("folder"));
    assert_true(fracas_folder_is_own("nothing"));
    assert_int_equal(symlink("folder", "to-folder"), 0);
    assert_false(fracas_folder_create("to-folder"));
    assert_int_equal(errno, ELOOP);
    write_victim();
    assert_false(fracas_folder_create("victim"));
    assert_int_equal(errno, ENOTDIR);
    assert_false(fracas_folder_create("no/where"));
    assert_int_equal(errno, ENOENT);
}

static int enter(void **state)
{
    return make_folder(state) || chdir(folder);
}

static int leave(void **state)
{
    return chdir("/") || remove_folder(state);
}

TESTS_ALL(enter, leave, no_file_is_refused_at_once, a_new_file_takes_the_place_of_a_link,
          folders_are_no_links)
