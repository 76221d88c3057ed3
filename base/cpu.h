/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef FRACAS_BASE_CPU_H
#define FRACAS_BASE_CPU_H

#include <stddef.h>

/* The CPU's name as the system has it, or "unknown". */
void fracas_cpu_name(char *name, size_t size);

#endif
