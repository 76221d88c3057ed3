/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Damage and death: flipped bytes, truncated files, a full disk, kill -9. */
#define STUDY_REPLICAS 4 /* few, as they are read a thousand times */
#define STUDY_ROWS 12
#include "campaigns/store/lock.h"
#include "campaigns/store/study.h"
#include "tests/support/upkeep.h"

#include <errno.h>
#include <fcntl.h>
#include <sys/resource.h>
#include <sys/syscall.h>

enum { KILLS = 12 };

/* HDF5 1.10 forgets an object header whose checksum is wrong; it is no leak of ours. */
const char *__lsan_default_suppressions(void);
const char *__lsan_default_suppressions(void)
{
    return "leak:libhdf5";
}

/* The calls that make a segment durable, seen and failed at will: these stand before those of the C
 * library. */
static char calls[64];      /* f: fsync of a file, d: of a folder, r: rename */
static int fail_at = -1;    /* number of the call that fails ... */
static int fail_with = EIO; /* ... with this */
static int dies_at = -1;    /* number of the fatal call, among these and all writing ones */
static bool renamed_open;   /* a file was renamed while it was open here */

static void may_die(void)
{
    if (dies_at >= 0 && dies_at-- == 0) kill(getpid(), SIGKILL);
}

static bool call_fails(char name)
{
    size_t number = strlen(calls);
    may_die();
    if (number + 1 < sizeof calls) calls[number] = name;
    if (fail_at < 0 || (size_t)fail_at != number) return false;
    errno = fail_with;
    return true;
}

/* From here on the first call fails, or a later one; -1: none. */
static void fail_call(int number)
{
    memset(calls, 0, sizeof calls);
    fail_at = number;
}

int fsync(int fd)
{
    struct stat info;
    bool folder = fstat(fd, &info) == 0 && S_ISDIR(info.st_mode);
    return call_fails(folder ? 'd' : 'f') ? -1 : (int)syscall(SYS_fsync, fd);
}

static bool is_open(const char *path)
{
    char entry[32], file[512];
    for (int fd = 0; fd < 256; fd++) {
        snprintf(entry, sizeof entry, "/proc/self/fd/%d", fd);
        const ssize_t length = readlink(entry, file, sizeof file);
        if (length > 0 && (size_t)length == strlen(path) && !memcmp(file, path, (size_t)length))
            return true;
    }
    return false;
}

int rename(const char *from, const char *to)
{
    renamed_open = renamed_open || is_open(from);
    return call_fails('r') ? -1 : (int)syscall(SYS_renameat, AT_FDCWD, from, AT_FDCWD, to);
}

int fdatasync(int fd)
{
    may_die();
    return (int)syscall(SYS_fdatasync, fd);
}

ssize_t pwrite(int fd, const void *bytes, size_t size, off_t at)
{
    may_die();
    return syscall(SYS_pwrite64, fd, bytes, size, at);
}

ssize_t pwrite64(int fd, const void *bytes, size_t size, off64_t at)
{
    return pwrite(fd, bytes, size, at);
}

/* The segment of all computed realizations. */
static const char *commit_all(void)
{
    commit_everything(0);
    return sample_path(study, "segments/s0.h5");
}

static void nothing_is_open(void)
{
    assert_int_equal(H5Fget_obj_count(H5F_OBJ_ALL, H5F_OBJ_ALL), 0);
}

/* ---- damaged segments ---- */

typedef enum { SAME, REPORTED, WRONG } reading;

static bool same_points(const fracas_point_table *found)
{
    bool same = found->npoints == SAMPLE_POINTS && found->ncolumns == 3;
    for (size_t p = 0; same && p < SAMPLE_POINTS; p++) {
        same = fracas_hash_equal(&found->point[p].hash, &point_row[p].hash) &&
               found->point[p].replicas == REPLICAS;
        for (size_t c = 0; same && c < 3; c++)
            same = !strcmp(found->column[c].path, sample_column[c].path) &&
                   !strcmp(found->column[c].unit, sample_column[c].unit) &&
                   !strcmp(found->point[p].value[c].text, sample_value[p][c].text) &&
                   (isnan(sample_value[p][c].real) ||
                    found->point[p].value[c].real == sample_value[p][c].real);
    }
    return same;
}

static bool same_header(const fracas_file_header *found)
{
    const fracas_file_header header = sample_header();
    return fracas_hash_equal(&found->campaign, &header.campaign) && found->seed == header.seed &&
           found->history == header.history && found->interfaces == header.interfaces &&
           !strcmp(found->version, header.version) && found->complete == header.complete;
}

/* By its own seal, as a segment is looked at that no index knows. */
static reading read_seal(const char *path)
{
    uint64_t version;
    fracas_err err = fracas_file_version(path, &version);
    if (!err) return version == FRACAS_FORMAT_VERSION ? SAME : WRONG;
    FAILS(err, FRACAS_DAMAGED, path);
    return REPORTED;
}

/* Reads everything: the same as was written, an error that names the file, or something else. */
static reading read_all(const char *path)
{
    fracas_reader *reader;
    fracas_err err = fracas_reader_open(path, &reader);
    bool same = true;
    if (!err) {
        same = fracas_reader_realizations(reader) == ALL &&
               same_points(fracas_reader_points(reader)) &&
               same_header(fracas_reader_header(reader));
        for (size_t i = 0; !err && same && i < ALL; i++) {
            FRACAS_CLEARED(fracas_record) wanted, found;
            size_t point;
            int64_t replica;
            fracas_record_init(&found);
            sample_record(i / REPLICAS, (int64_t)(i % REPLICAS), MOST, &wanted);
            sample_make_canonical(&wanted);
            err = fracas_reader_record(reader, i, FRACAS_READ_ALL, &point, &replica, &found);
            if (!err)
                same = point == i / REPLICAS && replica == (int64_t)(i % REPLICAS) &&
                       sample_equal(&wanted, &found);
        }
    }
    fracas_reader_close(reader);
    if (!err) return same ? SAME : WRONG;
    if (err != FRACAS_DAMAGED || !strstr(fracas_message(), path))
        print_error("code %d: %s\n", err, fracas_message());
    FAILS(err, FRACAS_DAMAGED, path);
    return REPORTED;
}

static void flipped_bytes_are_found(void **state)
{
    const char *path = commit_all();
    size_t size;
    OWNED unsigned char *bytes = whole_bytes(path, &size);
    assert_int_equal(read_all(path), SAME);
    assert_int_equal(read_seal(path), SAME);
    uint64_t random = 2;
    int fd = open(path, O_WRONLY), reported = 0;
    enum { FLIPS = 600 };
    for (int i = 0; i < FLIPS; i++) {
        size_t at = i < 200 ? (size_t)i
                            : sample_bits(&random) % size; /* the superblock, then anywhere */
        unsigned char damaged = bytes[at] ^ (unsigned char)(1 + sample_bits(&random) % 255);
        assert_int_equal(pwrite(fd, &damaged, 1, (off_t)at), 1);
        reading result = read_all(path);
        if (result == WRONG)
            print_error("byte %zu of %zu: %02x as %02x\n", at, size, bytes[at], damaged);
        assert_int_not_equal(result, WRONG);
        reported += result == REPORTED;
        assert_int_equal(read_seal(path), REPORTED);
        assert_int_equal(pwrite(fd, &bytes[at], 1, (off_t)at), 1);
    }
    /* What is not reported is space that HDF5 keeps free; most of a file is not that. */
    assert_true(reported > FLIPS / 2);
    nothing_is_open();
    close(fd);
}

static void truncated_files_are_found(void **state)
{
    const char *path = commit_all();
    size_t size;
    OWNED unsigned char *bytes = whole_bytes(path, &size);
    uint64_t random = 3;
    for (int i = 0; i < 100; i++) {
        write_bytes(path, bytes,
                    i < 10   ? (size_t)i
                    : i < 20 ? size - (size_t)(i - 9)
                             : sample_bits(&random) % size);
        assert_int_equal(read_all(path), i >= 10 && i < 20
                                             ? SAME
                                             : REPORTED); /* in the seal, which HDF5 does not see */
        assert_int_equal(read_seal(path), REPORTED);
    }
    /* Cut off as a whole the seal is missed no more than in a segment of before there were any. */
    write_bytes(path, bytes, size - FRACAS_OWN_SEAL);
    assert_int_equal(read_seal(path), SAME);
    nothing_is_open();
    for (int fd = 3; fd < 40; fd++) { /* nothing of them stays open */
        char link[64], target[512] = "";
        snprintf(link, sizeof link, "/proc/self/fd/%d", fd);
        assert_true(readlink(link, target, sizeof target - 1) < 0 || strcmp(target, path) != 0);
    }
}

/* HDF5 1.10 can go on without the links in a damaged part of a group's header: no column may be
 * missed. */
static void lost_columns_are_found(void **state)
{
    const char *path = commit_all();
    size_t size;
    OWNED unsigned char *bytes = whole_bytes(path, &size);
    for (int c = 0; c < 3; c++) {
        const char *name = sample_column[c].path;
        unsigned char *link = memmem(bytes, size, name, strlen(name));
        assert_non_null(link);
        link[strlen(name)] ^= 0x40; /* the address follows the name */
        write_bytes(path, bytes, size);
        assert_int_equal(read_all(path), REPORTED);
        link[strlen(name)] ^= 0x40;
    }
}

/* Rubbish over whole stretches: errors, never a crash. */
static void overwritten_stretches_are_found(void **state)
{
    const char *path = commit_all();
    size_t size;
    OWNED unsigned char *bytes = whole_bytes(path, &size), *damaged = taken(size);
    uint64_t random = 4;
    for (int i = 0; i < 60; i++) {
        memcpy(damaged, bytes, size);
        size_t first = i < 20 ? (size_t)i * 100 : sample_bits(&random) % size,
               length = 1 + sample_bits(&random) % 4096;
        for (size_t at = first; at < size && at < first + length; at++)
            damaged[at] = (unsigned char)sample_bits(&random);
        write_bytes(path, damaged, size);
        assert_int_not_equal(read_all(path), WRONG);
    }
    nothing_is_open();
}

/* A table `segment` that is damaged where SQLite does not see it. */
static void damaged_rows_of_the_index_are_found(void **state)
{
    static const char *const damage[] = {"checksum = '00000000000zzzzz'", "checksum = ''",
                                         "name = 'a/b'", "rows = -1"};
    fracas_segment_row none;
    commit_all();
    OK(fracas_index_commit(index_, "b.h5", &(fracas_file_seal){1, 2}, &none, 0, "{}"));
    for (size_t d = 0; d < FRACAS_COUNT(damage); d++) {
        char text[200];
        FRACAS_CLEARED(fracas_known_segments) known = {0};
        snprintf(text, sizeof text, "BEGIN; UPDATE segment SET %s WHERE id = 2", damage[d]);
        sql(text);
        FAILS(fracas_index_segments_by_id(index_, &known), FRACAS_DAMAGED, "segment");
        sql("ROLLBACK");
    }
    FRACAS_CLEARED(fracas_known_segments) known = {0};
    OK(fracas_index_segments_by_id(index_, &known));
    assert_int_equal(known.count, 2);
}

/* ---- a full disk ---- */

/* Files of this process cannot grow beyond `bytes`. */
static void limit_files(rlim_t bytes)
{
    struct rlimit limit;
    assert_int_equal(getrlimit(RLIMIT_FSIZE, &limit), 0);
    limit.rlim_cur = bytes;
    assert_int_equal(setrlimit(RLIMIT_FSIZE, &limit), 0);
}

/* 40 realizations of up to `most` rows a part into one file. */
static fracas_err write_some(const char *path, size_t most)
{
    const fracas_file_header header = sample_header();
    fracas_writer *writer;
    fracas_file_seal own;
    TRY(fracas_writer_create(path, &header, &table, &writer));
    for (int64_t r = 0; r < 40; r++) {
        fracas_record record;
        sample_record(0, r, most, &record);
        fracas_err err = fracas_writer_append(writer, 0, r, &record);
        fracas_record_clear(&record);
        if (err) {
            fracas_writer_abandon(writer);
            return err;
        }
    }
    return fracas_writer_finish(writer, true, &own);
}

static void full_disk_is_said_and_leaves_nothing(void **state)
{
    signal(SIGXFSZ, SIG_IGN);
    char *folder = sample_path(study, "segments"), *path = sample_path(study, "segments/big.h5");
    OK(write_some(path, 4000));
    struct stat whole;
    assert_int_equal(stat(path, &whole), 0);
    assert_int_equal(unlink(path), 0);
    for (int i = 0; i < 12; i++) { /* at the start, in the middle, in the last bytes */
        limit_files(i < 11 ? (rlim_t)(whole.st_size / 11 * i) : (rlim_t)whole.st_size - 1);
        FAILS(write_some(path, 4000), FRACAS_ENVIRONMENT, strerror(EFBIG));
        assert_has(fracas_message(), "big.h5");
        assert_int_equal(sample_files(folder, "big"), 0);
    }
    limit_files(RLIM_INFINITY);
    OK(write_some(path, 4000)); /* nothing of the failures is left in the library */
    fracas_reader *reader;
    OK(fracas_reader_open(path, &reader));
    assert_int_equal(fracas_reader_realizations(reader), 40);
    fracas_reader_close(reader);
    FAILS(write_some("/nowhere/at/all/a.h5", 1), FRACAS_ENVIRONMENT, strerror(ENOENT));
    assert_int_equal(mkdir(sample_path(study, "segments/taken.h5"), 0777), 0);
    FAILS(write_some(sample_path(study, "segments/taken.h5"), 1), FRACAS_ENVIRONMENT, "taken.h5");
    assert_int_equal(sample_files(folder, "tmp"), 0);
    nothing_is_open();
}

static void bytes_are_durable_before_their_name(void **state)
{
    char *folder = sample_path(study, "segments"), *path = sample_path(study, "segments/a.h5");
    fail_call(-1);
    OK(write_some(path, 10));
    assert_string_equal(calls, "frd");
    unlink(path);
    for (int call = 0; call < 3; call++) {
        fail_call(call);
        FAILS(write_some(path, 10), FRACAS_ENVIRONMENT, strerror(EIO));
        assert_int_equal(sample_files(folder, "tmp"), 0);
        /* When only the folder could not be synced the whole segment may be there, for recover to
         * adopt. */
        assert_int_equal(access(path, F_OK), call < 2 ? -1 : 0);
    }
    fail_at = -1;
}

/* What the system refuses, and what the person should do. */
static void limits_are_said_with_their_remedy(void **state)
{
    static const struct {
        int reason;
        const char *remedy;
    } limit[] = {{ENOSPC, "free some space"},
                 {EDQUOT, "quota"},
                 {EIO, "dmesg"},
                 {EROFS, "mount it to be written"},
                 {EFBIG, "ulimit -f"}};
    char *folder = sample_path(study, "segments"), *path = sample_path(study, "segments/a.h5");
    for (size_t l = 0; l < sizeof limit / sizeof *limit; l++) {
        for (int call = 0; call < 2; call++) {
            fail_with = limit[l].reason;
            fail_call(call);
            FAILS(write_some(path, 10), FRACAS_ENVIRONMENT, strerror(limit[l].reason));
            assert_has(fracas_message(), limit[l].remedy);
            assert_int_equal(sample_files(folder, "a.h5"), 0);
        }
    }
    fail_at = -1;
    fail_with = EIO;
}

static void too_many_open_files_are_said(void **state)
{
    struct rlimit before, none;
    fracas_index_close(index_);
    index_ = NULL;
    int next = dup(STDERR_FILENO), lock; /* files with smaller numbers than this are open */
    assert_int_equal(getrlimit(RLIMIT_NOFILE, &before), 0);
    close(next);
    none = (struct rlimit){(rlim_t)next, before.rlim_max};
    assert_int_equal(setrlimit(RLIMIT_NOFILE, &none), 0);
    FAILS(write_some(sample_path(study, "segments/a.h5"), 10), FRACAS_ENVIRONMENT, "ulimit -n");
    FAILS(fracas_study_lock(study, false, &lock), FRACAS_ENVIRONMENT, "ulimit -n");
    FAILS(fracas_index_open(study, false, &index_), FRACAS_ENVIRONMENT, "ulimit -n");
    assert_int_equal(setrlimit(RLIMIT_NOFILE, &before), 0);
    OK(write_some(sample_path(study, "segments/a.h5"), 10));
    OK(fracas_index_open(study, false, &index_));
}

/* Damage is found while the disk fails: nothing is lost by that, the next sweep goes on. */
static void setting_aside_can_fail_anywhere(void **state)
{
    const fracas_file_header header = sample_header();
    const char *path = commit_all(), *aside = sample_path(study, "segments/s0.damaged");
    char *report = NULL;
    flip_byte(path, 30000);
    for (const char *call = "rd"; *call; call++) {
        fail_call((int)(call - "rd"));
        FAILS(fracas_study_recover(study, index_, &header, &table, &report), FRACAS_ENVIRONMENT,
              strerror(EIO));
        assert_int_equal(calls[fail_at], *call);
        assert_int_equal(access(path, F_OK), *call == 'r' ? 0 : -1);
        assert_int_equal(access(aside, F_OK), *call == 'r' ? -1 : 0);
    }
    fail_at = -1;
    recover_says("s0.h5 is missing");
    assert_int_equal(count_all().planned, ALL);
    assert_int_equal(access(aside, F_OK), 0);
}

/* A merge that ends between the new study.h5 and its seal leaves none, so that it is merged again.
 */
static void an_interrupted_merge_leaves_no_seal(void **state)
{
    const fracas_file_header header = sample_header();
    commit_all();
    for (const char *call = "rd"; *call; call++) {
        merge();
        fail_call(-1);
        merge(); /* its calls are the next one's */
        assert_true(is_sealed());
        assert_non_null(strchr(calls, *call));
        fail_call((int)(strchr(calls, *call) - calls));
        FAILS(fracas_study_merge(study, index_, &header, &table, NULL, NULL), FRACAS_ENVIRONMENT,
              strerror(EIO));
        fail_at = -1;
        assert_false(is_sealed());
    }
}

/* A segment is damaged after its records were read. */
static fracas_err damage_it(const void *context, size_t point, fracas_stored_mesh *mesh)
{
    flip_byte(context, 30000);
    return fracas_fail(FRACAS_DAMAGED, "%s: damaged", (const char *)context);
}

static void a_merge_sets_no_open_segment_aside(void **state)
{
    const fracas_file_header header = sample_header();
    OWNED char *folder = realpath(study, NULL);
    const fracas_mesh_source meshes = {.get = damage_it,
                                       .context = sample_path(folder, "segments/s0.h5")};
    commit_all();
    renamed_open = false;
    FAILS(fracas_study_merge(folder, index_, &header, &table, &meshes, NULL), FRACAS_INTERRUPTED,
          "s0.damaged");
    assert_false(renamed_open);
}

/* A commit of one realization of the first point. */
static fracas_err commit_one(int64_t replica)
{
    const fracas_segment_row row = {
        point_row[0].hash, replica, 0, {FRACAS_INTACT, 1, 0, 10, 0.0, 0.0}};
    char name[32];
    snprintf(name, sizeof name, "s%lld.h5", (long long)replica);
    return fracas_index_commit(index_, name, &(fracas_file_seal){1, 2}, &row, 1, "{}");
}

static void full_disk_leaves_the_index_as_it_was(void **state)
{
    signal(SIGXFSZ, SIG_IGN);
    const fracas_index_counts before = count_all();
    limit_files(8192); /* less than the write-ahead log has already */
    FAILS(commit_one(0), FRACAS_ENVIRONMENT, "index.sqlite");
    assert_has(fracas_message(), "ulimit -f");
    limit_files(RLIM_INFINITY);
    const fracas_index_counts after = count_all();
    assert_memory_equal(&after, &before, sizeof after);
    OK(commit_one(0));
    assert_int_equal(count_all().planned, ALL - 1);
}

/* ---- kill -9 ---- */

/* Commits until it is killed; says each commit into the pipe after it is done. */
static void commit_until_killed(int out)
{
    OK(fracas_index_open(study, true, &index_));
    for (int64_t r = 0;; r++) {
        OK(commit_one(r));
        assert_int_equal(write(out, &r, sizeof r), sizeof r);
    }
}

/* Works in a process that is killed as it makes its call number `at`. The last that it said, or -1.
 */
static int64_t killed(void (*work)(int out), int at)
{
    int ends[2], status;
    int64_t r, last = -1;
    assert_int_equal(pipe(ends), 0);
    const pid_t child = fork();
    if (child == 0) {
        dies_at = at;
        work(ends[1]);
    }
    close(ends[1]);
    while (read(ends[0], &r, sizeof r) == sizeof r) last = r;
    close(ends[0]);
    assert_int_equal(waitpid(child, &status, 0), child);
    assert_true(WIFSIGNALED(status));
    return last;
}

static void commits_survive_the_death_of_the_process(void **state)
{
    point_row[0].replicas = 20000;
    OK(fracas_index_plan(index_, &table));
    int64_t committed = 0;
    for (int kills = 0; kills < KILLS; kills++) {
        fracas_index_close(index_);
        index_ = NULL;
        const int64_t told = killed(commit_until_killed, 7 * kills);
        open_again();
        const fracas_index_counts counts = count_all();
        assert_true(counts.done >= told + 1); /* all said is there */
        assert_true(counts.done >= committed);
        assert_int_equal(counts.done, counts.segments); /* and each whole */
        committed = counts.done;
        assert_int_equal(number("SELECT count(*) FROM pragma_integrity_check "
                                "WHERE integrity_check = 'ok'"),
                         1);
    }
    assert_true(committed > KILLS);
}

static void write_until_killed(int unused)
{
    for (int n = 0;; n++) {
        char name[60];
        snprintf(name, sizeof name, "segments/k%d-%d.h5", (int)getpid(), n);
        OK(write_some(sample_path(study, name), 30));
    }
}

/* A writer killed at any call leaves no segment under its final name but whole ones. */
static void segments_are_whole_or_not_there(void **state)
{
    OWNED char *folder = strdup(sample_path(study, "segments"));
    int whole = 0;
    for (int kills = 0; kills < KILLS; kills++) killed(write_until_killed, 61 * kills);
    DIR *list = opendir(folder);
    for (struct dirent *entry; (entry = readdir(list));) {
        fracas_reader *reader;
        if (entry->d_name[0] == '.') continue;
        OK(fracas_reader_open(sample_path(folder, entry->d_name), &reader));
        assert_int_equal(fracas_reader_realizations(reader), 40);
        for (size_t r = 0; r < 40; r++) {
            FRACAS_CLEARED(fracas_record) record;
            size_t point;
            int64_t replica;
            fracas_record_init(&record);
            OK(fracas_reader_record(reader, r, FRACAS_READ_ALL, &point, &replica, &record));
        }
        fracas_reader_close(reader);
        whole++;
    }
    closedir(list);
    assert_true(whole > 0);
}

TESTS_EACH(set_up, tear_down, flipped_bytes_are_found, lost_columns_are_found,
           truncated_files_are_found, overwritten_stretches_are_found,
           damaged_rows_of_the_index_are_found, full_disk_is_said_and_leaves_nothing,
           bytes_are_durable_before_their_name, an_interrupted_merge_leaves_no_seal,
           a_merge_sets_no_open_segment_aside, limits_are_said_with_their_remedy,
           too_many_open_files_are_said, setting_aside_can_fail_anywhere,
           full_disk_leaves_the_index_as_it_was, commits_survive_the_death_of_the_process,
           segments_are_whole_or_not_there)
