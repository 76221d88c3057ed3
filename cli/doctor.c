/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The command doctor: what a run needs, and whether it is there. */
#include "cli/doctor.h"

#include "base/file.h"
#include "base/json.h"
#include "base/own.h"
#include "base/terminal.h"
#include "base/text.h"
#include "cli/cli.h"

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

void fracas_patient_say(fracas_patient *patient, fracas_health health, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(patient->text, sizeof patient->text, format, arguments);
    va_end(arguments);
    patient->health = health;
}

bool fracas_patient_fails(fracas_patient *patient, fracas_err err)
{
    if (err) fracas_patient_say(patient, FRACAS_WRONG, "%s", fracas_message());
    return err != FRACAS_OK;
}

bool fracas_patient_write(const fracas_patient *patient, const char *name, const char *text)
{
    char path[PATH_MAX + 64];
    snprintf(path, sizeof path, "%s/%s", patient->own, name);
    FILE *out = fracas_file_stream(fracas_file_create(path), "w");
    if (!out) return false;
    const bool bad = fputs(text, out) < 0;
    return !fclose(out) && !bad;
}

/* ---- output ---- */

static const struct {
    const char *word, *key;
    fracas_colour colour;
} health_of[] = {[FRACAS_SOUND] = {"ok", "ok", FRACAS_GREEN},
                 [FRACAS_NOTED] = {"note", "note", FRACAS_YELLOW},
                 [FRACAS_WRONG] = {"WRONG", "wrong", FRACAS_RED}};

typedef struct {
    fracas_json *json; /* NULL: text */
    bool quiet;
    int columns; /* the terminal has; 0: none */
    int all, wrong;
    char names[512]; /* checks that found something */
} report;

static void tell(report *to, const char *name, const fracas_patient *patient)
{
    enum { BEFORE = 20 };
    to->all++;
    if (patient->health == FRACAS_WRONG) {
        const size_t used = strlen(to->names);
        snprintf(to->names + used, sizeof to->names - used, "%s%s", to->wrong++ ? ", " : "", name);
    }
    if (to->json) {
        fracas_json_object(to->json, NULL);
        fracas_json_text(to->json, "name", name);
        fracas_json_text(to->json, "health", health_of[patient->health].key);
        fracas_json_text(to->json, "text", patient->text);
        fracas_json_close(to->json);
    } else if (!to->quiet || patient->health != FRACAS_SOUND) {
        fracas_paint(health_of[patient->health].colour);
        printf("%-6s", health_of[patient->health].word);
        fracas_paint(FRACAS_PLAIN);
        printf(" %-12s ", name);
        fracas_text_wrap(patient->text, BEFORE, to->columns, stdout);
    }
}

static void look_at(report *to, const fracas_checkup *checkup, fracas_patient *patient)
{
    for (; checkup->name; checkup++) {
        patient->health = FRACAS_SOUND;
        *patient->text = '\0';
        checkup->look(patient);
        tell(to, checkup->name, patient);
        if (!to->json) fflush(stdout);
    }
}

/* A folder of our own in the patient's. */
static void admit(fracas_patient *patient)
{
    if (snprintf(patient->own, sizeof patient->own, "%s/.fracas-doctor-XXXXXX", patient->folder) >=
            (int)sizeof patient->own ||
        !mkdtemp(patient->own))
        *patient->own = '\0';
}

static fracas_err doctor(const fracas_arguments *arguments)
{
    fracas_json json;
    fracas_patient patient = {.folder = arguments->operand};
    report to = {.json = fracas_given(arguments, "json") ? &json : NULL,
                 .quiet = fracas_given(arguments, "quiet"),
                 .columns = fracas_terminal_of(STDOUT_FILENO).columns};
    if (!patient.folder) patient.folder = ".";
    if (to.json) {
        fracas_json_begin(&json, stdout);
        fracas_json_text(&json, "folder", patient.folder);
        fracas_json_array(&json, "checks");
    }
    admit(&patient);
    look_at(&to, fracas_checkups_machine, &patient);
    look_at(&to, fracas_checkups_folder, &patient);
    look_at(&to, fracas_checkups_run, &patient);
    if (*patient.own) fracas_folder_remove(patient.own);
    if (to.json) {
        fracas_json_close(&json);
        fracas_json_integer(&json, "wrong", to.wrong);
        fracas_json_end(&json);
    }
    if (!to.wrong) return FRACAS_OK;
    return fracas_fail(FRACAS_ENVIRONMENT, "doctor: %d of %d checks found something wrong: %s",
                       to.wrong, to.all, to.names);
}

static const fracas_option options[] = {
    {"json", NULL, "print it as JSON"}, {"quiet", NULL, "print only what is not ok"}, {0}};

const fracas_command fracas_command_doctor = {
    .name = "doctor",
    .operand = "FOLDER",
    .optional = true,
    .doc = "Checks what a run needs: libraries, machine, MPI, and FOLDER for studies",
    .more = "\nEach line is ok, a note, or WRONG with what to do. It runs two small bodies in a "
            "folder of its own in FOLDER (the current one), by\n"
            "its own processes and by mpirun, and removes that. The status is 6 if something is "
            "wrong.\n",
    .options = options,
    .run = doctor,
};
