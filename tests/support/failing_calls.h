/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A shared object that is loaded into `fracas` (LD_PRELOAD) and makes the k-th call of a class
 * fail, or kills the process there.
 *
 *   FAILING_CALLS  "CLASS WHERE K HOW": K counted from 1; 0 only counts. Or "CLASS WHERE SITE@K
 *                  HOW": the k-th call from this place in the program; 0@0 enters all places
 *     CLASS  disk: system calls that change files of the study, whoever makes them (C library,
 *            SQLite, HDF5); read: those that read them
 *            sqlite, hdf5, mpi: calls of these libraries by fracas
 *            memory: allocations of fracas and of the libraries that it stores with
 *            process: fork, pipe2, socketpair
 *            wait: calls of fracas that a signal may interrupt, or that transfer a part
 *            system: these, and others of fracas that the system may refuse
 *     WHERE  parent; starter; or RANK.DEPTH: 0.0 is rank 0, 0.1 its supervisor, 0.2 the server, 0.3
 * the process of a lease HOW    an error of errno (EIO, ENOSPC, EINTR, ...) or of the library;
 * kill: the process dies before the call; torn: it dies after half of what it was to write; late:
 * the call succeeds, and says that it has not; short: half of it is transferred FAILING_STATE  file
 * of a failing_state: what was counted; with ENOSPC, all calls that need space fail from then on,
 * everywhere FAILING_ALONE  set where the parent starts no mpirun: only then its system calls can
 * be watched FAILING_UNDER  part of the path of every file of the study, and of no other */
#ifndef FRACAS_TESTS_SUPPORT_FAILING_CALLS_H
#define FRACAS_TESTS_SUPPORT_FAILING_CALLS_H

#include <stdbool.h>
#include <stdint.h>

typedef enum {
    FAILING_DISK,
    FAILING_READ,
    FAILING_SQLITE,
    FAILING_HDF5,
    FAILING_MPI,
    FAILING_MEMORY,
    FAILING_PROCESS,
    FAILING_WAIT,
    FAILING_SYSTEM,
    FAILING_NCLASSES
} failing_class;

enum {
    FAILING_RANKS = 4,
    FAILING_DEPTHS = 4,
    FAILING_STARTER = 1 + FAILING_RANKS * FAILING_DEPTHS, /* the parent first */
    FAILING_WHERES,
    FAILING_SITES = 4096
};

typedef struct {
    uint64_t count[FAILING_WHERES][FAILING_NCLASSES];
    struct {
        uint64_t key, count; /* 0: none */
    } site[FAILING_SITES];
    uint64_t full;    /* the disk is */
    char failed[232]; /* the call that failed, in words; "" if none did */
} failing_state;

typedef enum { FAILING_NOT, FAILING_NOW, FAILING_LATE } failing_verdict;

/* True for the return address of a call that the program itself makes: libraries call their own
 * functions too. */
bool failing_by_program(const void *caller);

/* Its place in the program's code, wherever that is loaded. */
uint64_t failing_in_program(const void *caller);

/* Counts a call of this process; the process may die here. `what` is its name, `on` what it is
 * about or NULL. */
failing_verdict failing_call(failing_class class, const char *what, const char *on);

/* If they are not 0: the code, the errno and the system_errno with which calls of SQLite fail. */
extern int failing_sqlite_as, failing_sqlite_errno, failing_sqlite_system;

#endif
