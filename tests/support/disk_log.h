/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Every change of the files below one folder in its order, as disk_recorder.c writes it and
 * disk_model.c reads it: a disk_log_head, then entries, each with its texts and bytes behind it. */
#ifndef FRACAS_TESTS_SUPPORT_DISK_LOG_H
#define FRACAS_TESTS_SUPPORT_DISK_LOG_H

#include <stdint.h>

typedef enum {
    DISK_CREATE,   /* a new file `node`, its name in `folder` */
    DISK_MKDIR,    /* a new folder `node` */
    DISK_WRITE,    /* `size` bytes at `at` of `node` */
    DISK_TRUNCATE, /* `node` to `at` bytes */
    DISK_SYNC,     /* of `node`, a file or a folder */
    DISK_LINK,     /* one name more of `node` */
    DISK_RENAME,   /* of `node`, from a name in `folder` to the second in `other` */
    DISK_REMOVE,   /* a name in `folder`, of a file or an empty folder */
    DISK_PROMISE,  /* what an index calls durable, and its path, as texts (disk_recorder.c) */
    DISK_BEGIN,    /* a process of the program starts */
    DISK_UNKNOWN,  /* a call unknown to the model */
    DISK_NKINDS
} disk_kind;

/* Nodes are numbers of inodes, names have no folder. */
typedef struct {
    uint32_t kind, pid;
    uint64_t node, folder, other, at;
    uint32_t text; /* bytes of the names behind it, each with its end */
    uint32_t size; /* bytes behind these */
} disk_entry;

typedef struct {
    char mark[8];
    uint64_t end;   /* of the last entry [bytes] */
    uint64_t root;  /* node of the folder */
    uint32_t owner; /* thread adding an entry, 0: none */
    uint32_t rest;
} disk_log_head;

#define DISK_LOG_MARK "disklog"

#endif
