/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The engine of a simulated farm: realizations that take time and hash. A lane is a ring of cells;
 * a step makes each of them from itself and its neighbour. Processes for one body have some cells
 * each. */
#ifndef FRACAS_TESTS_SIMULATOR_ENGINE_H
#define FRACAS_TESTS_SIMULATOR_ENGINE_H

#include <stdint.h>

/* Makes the state behind a checkpoint's head one that no realization has. */
void engine_spoil(void *state);

#endif
