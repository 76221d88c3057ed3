/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Checks of `fracas doctor`: each looks at one thing that a run needs. */
#ifndef FRACAS_CLI_DOCTOR_H
#define FRACAS_CLI_DOCTOR_H

#include "base/err.h"

#include <stdbool.h>

typedef enum { FRACAS_SOUND, FRACAS_NOTED, FRACAS_WRONG } fracas_health;

typedef struct {
    const char *folder; /* for studies */
    char own[4096];     /* a folder of the checks' own in it; "": it could not be made */
    fracas_health health;
    char text[1200]; /* the finding; of anything but FRACAS_SOUND also the remedy */
} fracas_patient;

typedef struct {
    const char *name;
    void (*look)(fracas_patient *patient);
} fracas_checkup;

/* Tables, each up to one without a name. */
extern const fracas_checkup fracas_checkups_machine[], fracas_checkups_folder[],
    fracas_checkups_run[];

/* A finding; FRACAS_SOUND is what a check begins with. */
void fracas_patient_say(fracas_patient *patient, fracas_health health, const char *format, ...)
    FRACAS_PRINTF(3, 4);
/* FRACAS_WRONG with the present message, if `err` is one. */
bool fracas_patient_fails(fracas_patient *patient, fracas_err err);
/* Writes a text to a new file of patient->own; false, and errno. */
bool fracas_patient_write(const fracas_patient *patient, const char *name, const char *text);

#endif
