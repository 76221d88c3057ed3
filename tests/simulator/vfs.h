/* SPDX-License-Identifier: GPL-3.0-or-later */
/* SQLite on the simulated disk: a VFS whose files, locks and shared memory are there. */
#ifndef FRACAS_TESTS_SIMULATOR_VFS_H
#define FRACAS_TESTS_SIMULATOR_VFS_H

#include "tests/simulator/world.h"

/* From here on every database of this process is there. Once. */
void vfs_register(void);
/* The process has ended: its locks are free. */
void vfs_ended(const process *p);

#endif
