/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the processes of a simulated farm get in place of the C library's calls: files of the
 * simulated disk, sockets between processes, clocks, an environment each. The linker puts these in
 * (ld --wrap). */
#ifndef FRACAS_TESTS_SIMULATOR_CALLS_H
#define FRACAS_TESTS_SIMULATOR_CALLS_H

#include "tests/simulator/disk.h"

/* Two connected sockets, of which each side may be given to another process (descriptor_give). Its
 * buffer takes `capacity` bytes. */
void calls_pair(int fd[2], size_t capacity);
/* Bytes for whoever reads the other side, as many as there may be. */
void calls_tell(int fd, const void *bytes, size_t size);

/* Seconds of the monotonic clock, of the day since 1970. */
double calls_monotonic(void);
double calls_day(void);

void calls_set_environment(process *p, const char *name, const char *value);

#endif
