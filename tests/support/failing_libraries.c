/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Calls of SQLite and HDF5 that fail as these libraries fail. */
#include "tests/support/failing_calls.h"

#include <dlfcn.h>
#include <errno.h>
#include <hdf5.h>
#include <sqlite3.h>
#include <stddef.h>
#include <string.h>

/* Only of the program's own calls, which alone can be expected to look at what they give. */
#define FAILS(class, what, on) \
    (failing_by_program(__builtin_return_address(0)) ? failing_call(class, what, on) : FAILING_NOT)

#define REAL(type, name, parameters) \
    static type(*real) parameters;   \
    if (!real) real = (type(*) parameters)dlsym(RTLD_NEXT, #name)

/* ---- SQLite ---- */

static int injected; /* what sqlite3_errcode says until the next call that does not fail */
static sqlite3_stmt *textless; /* a text of its row found no memory */

int failing_sqlite_as, failing_sqlite_errno, failing_sqlite_system;

/* The call fails with this code, or with the one that was asked for. */
static int inject(int code)
{
    injected = failing_sqlite_as ? failing_sqlite_as : code;
    if (failing_sqlite_errno) errno = failing_sqlite_errno;
    return injected;
}

int sqlite3_system_errno(sqlite3 *db)
{
    REAL(int, sqlite3_system_errno, (sqlite3 *));
    return injected && failing_sqlite_system ? failing_sqlite_system : real(db);
}

#define SQLITE(name, code, parameters, arguments)                                      \
    int sqlite3_##name parameters                                                      \
    {                                                                                  \
        REAL(int, sqlite3_##name, parameters);                                         \
        const failing_verdict verdict = FAILS(FAILING_SQLITE, "sqlite3_" #name, NULL); \
        injected = 0;                                                                  \
        if (verdict == FAILING_NOW) return inject(code);                               \
        const int result = real arguments;                                             \
        return verdict ? inject(code) : result;                                        \
    }
SQLITE(bind_int64, SQLITE_NOMEM, (sqlite3_stmt * statement, int n, sqlite3_int64 value),
       (statement, n, value))
SQLITE(bind_double, SQLITE_NOMEM, (sqlite3_stmt * statement, int n, double value),
       (statement, n, value))
SQLITE(bind_null, SQLITE_NOMEM, (sqlite3_stmt * statement, int n), (statement, n))
SQLITE(bind_text, SQLITE_NOMEM,
       (sqlite3_stmt * statement, int n, const char *text, int size, void (*destroy)(void *)),
       (statement, n, text, size, destroy))

SQLITE(wal_checkpoint_v2, SQLITE_IOERR,
       (sqlite3 * db, const char *name, int mode, int *frames, int *done),
       (db, name, mode, frames, done))

/* ROLLBACK rolls back, whatever it says. */
int sqlite3_exec(sqlite3 *db, const char *sql, int (*row)(void *, int, char **, char **),
                 void *context, char **message)
{
    REAL(int, sqlite3_exec,
         (sqlite3 *, const char *, int (*)(void *, int, char **, char **), void *, char **));
    const failing_verdict verdict = FAILS(FAILING_SQLITE, "sqlite3_exec", NULL);
    injected = 0;
    if (verdict == FAILING_NOW && strcmp(sql, "ROLLBACK") != 0) return inject(SQLITE_IOERR);
    const int result = real(db, sql, row, context, message);
    return verdict ? inject(SQLITE_IOERR) : result;
}

/* Without memory it gives no text, and the next step of the statement says why. */
const unsigned char *sqlite3_column_text(sqlite3_stmt *statement, int column)
{
    REAL(const unsigned char *, sqlite3_column_text, (sqlite3_stmt *, int));
    if (!FAILS(FAILING_SQLITE, "sqlite3_column_text", NULL)) return real(statement, column);
    textless = statement;
    injected = SQLITE_NOMEM;
    return NULL;
}

int sqlite3_reset(sqlite3_stmt *statement)
{
    REAL(int, sqlite3_reset, (sqlite3_stmt *));
    if (textless == statement) textless = NULL;
    return real(statement);
}

int sqlite3_step(sqlite3_stmt *statement)
{
    REAL(int, sqlite3_step, (sqlite3_stmt *));
    const failing_verdict verdict = FAILS(FAILING_SQLITE, "sqlite3_step", NULL);
    const bool no_text = textless == statement;
    if (no_text) textless = NULL;
    injected = no_text ? SQLITE_NOMEM : 0;
    if (no_text) return injected;
    if (verdict == FAILING_NOW) return inject(SQLITE_IOERR);
    const int result = real(statement);
    return verdict ? inject(SQLITE_IOERR) : result;
}

/* On failure they give nothing, as the real ones do. */
int sqlite3_prepare_v2(sqlite3 *db, const char *sql, int size, sqlite3_stmt **statement,
                       const char **tail)
{
    REAL(int, sqlite3_prepare_v2, (sqlite3 *, const char *, int, sqlite3_stmt **, const char **));
    if (!FAILS(FAILING_SQLITE, "sqlite3_prepare_v2", NULL))
        return injected = 0, real(db, sql, size, statement, tail);
    *statement = NULL;
    return injected = SQLITE_NOMEM;
}

int sqlite3_prepare_v3(sqlite3 *db, const char *sql, int size, unsigned flags,
                       sqlite3_stmt **statement, const char **tail)
{
    REAL(int, sqlite3_prepare_v3,
         (sqlite3 *, const char *, int, unsigned, sqlite3_stmt **, const char **));
    if (!FAILS(FAILING_SQLITE, "sqlite3_prepare_v3", NULL))
        return injected = 0, real(db, sql, size, flags, statement, tail);
    *statement = NULL;
    return injected = SQLITE_NOMEM;
}

int sqlite3_open_v2(const char *path, sqlite3 **db, int flags, const char *vfs)
{
    REAL(int, sqlite3_open_v2, (const char *, sqlite3 **, int, const char *));
    if (!FAILS(FAILING_SQLITE, "sqlite3_open_v2", path))
        return injected = 0, real(path, db, flags, vfs);
    *db = NULL; /* no memory even for that */
    return injected = SQLITE_NOMEM;
}

int sqlite3_errcode(sqlite3 *db)
{
    REAL(int, sqlite3_errcode, (sqlite3 *));
    return injected ? injected : real(db);
}

const char *sqlite3_errmsg(sqlite3 *db)
{
    REAL(const char *, sqlite3_errmsg, (sqlite3 *));
    return injected ? sqlite3_errstr(injected) : real(db);
}

/* ---- HDF5 ---- */

/* Any call of HDF5 can fail for want of memory: as it would say so. */
static void no_room(const char *function)
{
    (void)H5Epush2(H5E_DEFAULT, __FILE__, function, __LINE__, H5E_ERR_CLS, H5E_RESOURCE,
                   H5E_NOSPACE, "no memory, by a test");
}

/* It closes the file and then says that it has not: a file that stays open would be a fault of this
 * test. */
herr_t H5Fclose(hid_t id)
{
    REAL(herr_t, H5Fclose, (hid_t));
    const failing_verdict verdict = FAILS(FAILING_HDF5, "H5Fclose", NULL);
    const herr_t result = real(id);
    if (verdict) no_room("H5Fclose");
    return verdict ? -1 : result;
}

#define HDF5(type, name, parameters, arguments)                           \
    type name parameters                                                  \
    {                                                                     \
        REAL(type, name, parameters);                                     \
        const failing_verdict verdict = FAILS(FAILING_HDF5, #name, NULL); \
        if (!verdict) return real arguments;                              \
        if (verdict == FAILING_LATE) (void)real arguments;                \
        no_room(#name);                                                   \
        return (type)-1;                                                  \
    }
HDF5(hid_t, H5Fcreate, (const char *name, unsigned flags, hid_t creation, hid_t access),
     (name, flags, creation, access))
HDF5(hid_t, H5Fopen, (const char *name, unsigned flags, hid_t access), (name, flags, access))
HDF5(herr_t, H5Fflush, (hid_t id, H5F_scope_t scope), (id, scope))
HDF5(hid_t, H5Dcreate2,
     (hid_t at, const char *name, hid_t type, hid_t space, hid_t link, hid_t creation,
      hid_t access),
     (at, name, type, space, link, creation, access))
HDF5(hid_t, H5Dopen2, (hid_t at, const char *name, hid_t access), (at, name, access))
HDF5(herr_t, H5Dset_extent, (hid_t id, const hsize_t *size), (id, size))
HDF5(herr_t, H5Dwrite,
     (hid_t id, hid_t memory, hid_t mspace, hid_t fspace, hid_t list, const void *buffer),
     (id, memory, mspace, fspace, list, buffer))
HDF5(herr_t, H5Dread,
     (hid_t id, hid_t memory, hid_t mspace, hid_t fspace, hid_t list, void *buffer),
     (id, memory, mspace, fspace, list, buffer))
HDF5(hid_t, H5Dget_type, (hid_t id), (id))
HDF5(hid_t, H5Dget_space, (hid_t id), (id))
HDF5(hid_t, H5Dget_create_plist, (hid_t id), (id))
HDF5(hid_t, H5Acreate_by_name,
     (hid_t at, const char *object, const char *name, hid_t type, hid_t space, hid_t acpl,
      hid_t aapl, hid_t lapl),
     (at, object, name, type, space, acpl, aapl, lapl))
HDF5(hid_t, H5Aopen_by_name,
     (hid_t at, const char *object, const char *name, hid_t aapl, hid_t lapl),
     (at, object, name, aapl, lapl))
HDF5(herr_t, H5Awrite, (hid_t id, hid_t type, const void *buffer), (id, type, buffer))
HDF5(herr_t, H5Aread, (hid_t id, hid_t type, void *buffer), (id, type, buffer))
HDF5(hid_t, H5Aget_space, (hid_t id), (id))
HDF5(hid_t, H5Aget_type, (hid_t id), (id))
HDF5(hid_t, H5Gcreate2, (hid_t at, const char *name, hid_t link, hid_t creation, hid_t access),
     (at, name, link, creation, access))
HDF5(hid_t, H5Screate, (H5S_class_t kind), (kind))
HDF5(hid_t, H5Screate_simple, (int rank, const hsize_t *size, const hsize_t *most),
     (rank, size, most))
HDF5(herr_t, H5Sselect_hyperslab,
     (hid_t id, H5S_seloper_t how, const hsize_t *from, const hsize_t *stride, const hsize_t *count,
      const hsize_t *block),
     (id, how, from, stride, count, block))
HDF5(hid_t, H5Tcopy, (hid_t id), (id))
HDF5(herr_t, H5Tset_size, (hid_t id, size_t size), (id, size))
HDF5(hid_t, H5Pcreate, (hid_t class), (class))
HDF5(herr_t, H5Pset_chunk, (hid_t id, int rank, const hsize_t *size), (id, rank, size))
HDF5(herr_t, H5Pset_filter,
     (hid_t id, H5Z_filter_t filter, unsigned flags, size_t n, const unsigned *values),
     (id, filter, flags, n, values))
HDF5(herr_t, H5Pset_fletcher32, (hid_t id), (id))
HDF5(herr_t, H5Pset_driver, (hid_t id, hid_t driver, const void *info), (id, driver, info))
HDF5(herr_t, H5Pset_chunk_cache, (hid_t id, size_t slots, size_t bytes, double w0),
     (id, slots, bytes, w0))
HDF5(herr_t, H5Pset_obj_track_times, (hid_t id, hbool_t on), (id, on))
HDF5(herr_t, H5Pset_fill_time, (hid_t id, H5D_fill_time_t when), (id, when))
HDF5(herr_t, H5Pset_libver_bounds, (hid_t id, H5F_libver_t low, H5F_libver_t high), (id, low, high))
HDF5(herr_t, H5Pset_fclose_degree, (hid_t id, H5F_close_degree_t degree), (id, degree))
HDF5(herr_t, H5Tset_strpad, (hid_t id, H5T_str_t pad), (id, pad))
HDF5(herr_t, H5Tset_cset, (hid_t id, H5T_cset_t set), (id, set))
HDF5(htri_t, H5Tequal, (hid_t a, hid_t b), (a, b))
HDF5(htri_t, H5Lexists, (hid_t at, const char *name, hid_t list), (at, name, list))
HDF5(htri_t, H5Aexists_by_name, (hid_t at, const char *object, const char *name, hid_t list),
     (at, object, name, list))
HDF5(int, H5Sget_simple_extent_ndims, (hid_t id), (id))
HDF5(int, H5Sget_simple_extent_dims, (hid_t id, hsize_t *size, hsize_t *most), (id, size, most))
HDF5(int, H5Pget_chunk, (hid_t id, int rank, hsize_t *size), (id, rank, size))
HDF5(H5D_layout_t, H5Pget_layout, (hid_t id), (id))
HDF5(int, H5Pget_nfilters, (hid_t id), (id))
