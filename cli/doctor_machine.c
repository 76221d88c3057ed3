/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Libraries, processor, memory, limits, clock. */
#include "cli/doctor.h"

#include "analysis/report/page.h"
#include "base/cpu.h"
#include "base/isa.h"
#include "base/own.h"
#include "base/version.h"
#include "campaigns/plan/plan.h"
#include "campaigns/scheduler/launch/allocation.h"
#include "campaigns/scheduler/launch/quota.h"
#include "campaigns/scheduler/launch/scratch.h"
#include "campaigns/scheduler/launch/starter.h"
#include "campaigns/store/datafile.h"

#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/statvfs.h>
#include <time.h>
#include <unistd.h>

/* ---- program and libraries ---- */

static void look_at_program(fracas_patient *patient)
{
    fracas_isa isa;
    char cpu[256];
    if (fracas_patient_fails(patient, fracas_isa_choose(FRACAS_ISA_BEST, &isa))) return;
    fracas_cpu_name(cpu, sizeof cpu);
    fracas_patient_say(patient, FRACAS_SOUND,
                       "fracas " FRACAS_VERSION " by %s; kernels for %s, up to %d lanes, on %s",
                       fracas_compiler, fracas_isa_name[isa],
                       fracas_isa_lanes(isa, FRACAS_LANES_MAX), cpu);
}

/* "1.10.8": files and database need the library of the headers, or a later one of its series. */
static void compare(fracas_patient *patient, const char *name, const char *built, const char *found)
{
    int of_built[3] = {0}, of_found[3] = {0};
    sscanf(built, "%d.%d.%d", &of_built[0], &of_built[1], &of_built[2]);
    sscanf(found, "%d.%d.%d", &of_found[0], &of_found[1], &of_found[2]);
    const bool older = of_found[1] < of_built[1] ||
                       (of_found[1] == of_built[1] && of_found[2] < of_built[2]);
    if (of_built[0] != of_found[0] || older)
        fracas_patient_say(patient, FRACAS_WRONG,
                           "%s %s is loaded, but fracas was built with %s: build it again, or take "
                           "the other library out of LD_LIBRARY_PATH",
                           name, found, built);
    else fracas_patient_say(patient, FRACAS_SOUND, "%s %s, built with %s", name, found, built);
}

static void look_at_hdf5(fracas_patient *patient)
{
    char found[32];
    fracas_hdf5_version(found);
    compare(patient, "HDF5", fracas_hdf5_built, found);
}

static void look_at_sqlite(fracas_patient *patient)
{
    compare(patient, "SQLite", fracas_sqlite_built, fracas_sqlite_version());
}

static void look_at_pdf(fracas_patient *patient)
{
    if (!fracas_convert_possible)
        fracas_patient_say(patient, FRACAS_NOTED,
                           "built without librsvg: figures are SVG and CSV, not PDF; for those "
                           "install Debian's librsvg2-dev and build again");
    else if (!fracas_patient_fails(patient, fracas_convert_check()))
        fracas_patient_say(patient, FRACAS_SOUND, "librsvg draws figures as PDF");
}

/* ---- limits of this process ---- */

/* The least number in FILE of the control groups of this process; INFINITY: none. */
static double limit_of_group(const char *file)
{
    char line[PATH_MAX] = "", group[PATH_MAX] = "", path[2 * PATH_MAX];
    double least = INFINITY;
    OWN(FILE) in = fopen("/proc/self/cgroup", "re");
    while (in && fgets(line, sizeof line, in))
        if (!strncmp(line, "0::", 3)) snprintf(group, sizeof group, "%s", line + 3);
    group[strcspn(group, "\n")] = '\0';
    for (;;) {
        double limit;
        snprintf(path, sizeof path, "/sys/fs/cgroup%s/%s", group, file);
        OWN(FILE) of = fopen(path, "re");
        if (of && fscanf(of, "%lf", &limit) == 1) least = fmin(least, limit);
        char *slash = strrchr(group, '/');
        if (!slash) return least;
        *slash = '\0';
    }
}

static void look_at_cores(fracas_patient *patient)
{
    const int mine = fracas_allocation_cores();
    const long online = sysconf(_SC_NPROCESSORS_ONLN);
    const double quota = fracas_quota_cores(FRACAS_QUOTA_GROUPS, FRACAS_QUOTA_MOUNT);
    if (quota < INFINITY)
        fracas_patient_say(patient, FRACAS_SOUND,
                           "%d of %ld cores for this process, whose control group gives the time "
                           "of %.3g",
                           mine, online, quota);
    else
        fracas_patient_say(patient, FRACAS_SOUND, "%d of %ld cores for this process", mine, online);
}

/* A value of /proc/meminfo [bytes]; NaN without it. */
static double memory_of(const char *key)
{
    char line[256];
    double kilobytes;
    OWN(FILE) in = fopen("/proc/meminfo", "re");
    while (in && fgets(line, sizeof line, in))
        if (!strncmp(line, key, strlen(key)) &&
            sscanf(line + strlen(key), ": %lf kB", &kilobytes) == 1)
            return 1024 * kilobytes;
    return NAN;
}

static void look_at_memory(fracas_patient *patient)
{
    static const double least = 2e8;
    char free_text[FRACAS_SIZE_TEXT], all[FRACAS_SIZE_TEXT];
    struct rlimit limit;
    double most = INFINITY;
    const char *by = "this machine";
    const double available = memory_of("MemAvailable"),
                 group = limit_of_group("memory.max") - limit_of_group("memory.current");
    if (available < most) most = available;
    if (group < most) most = group, by = "the control group";
    if (!getrlimit(RLIMIT_AS, &limit) && (double)limit.rlim_cur < most &&
        limit.rlim_cur != RLIM_INFINITY)
        most = (double)limit.rlim_cur, by = "the limit of a process (`ulimit -v`)";
    fracas_size_write(most, free_text);
    if (most < least)
        fracas_patient_say(patient, FRACAS_WRONG,
                           "%s leaves %s; a run takes 100 MB and more a process (`fracas plan` "
                           "says how much): free some, or raise that limit",
                           by, free_text);
    else
        fracas_patient_say(patient, FRACAS_SOUND, "%s of memory to be had, from %s with %s",
                           free_text, by, fracas_size_write(memory_of("MemTotal"), all));
}

static void look_at_files(fracas_patient *patient)
{
    const int jobs = fracas_allocation_cores();
    struct rlimit limit;
    if (fracas_patient_fails(patient, fracas_starter_local.check(jobs)) ||
        fracas_patient_fails(patient, fracas_starter_mpirun.check(jobs)))
        return;
    if (getrlimit(RLIMIT_NOFILE, &limit)) return;
    fracas_patient_say(patient, FRACAS_SOUND, "a process may open %llu files, enough for %d jobs",
                       (unsigned long long)limit.rlim_cur, jobs);
}

/* ---- clock, places for small files ---- */

static double seconds_of(clockid_t clock)
{
    struct timespec t = {0};
    clock_gettime(clock, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* Rates, leases and deadlines are by it. */
static void look_at_clock(fracas_patient *patient)
{
    enum { READINGS = 200000 };
    const struct timespec nap = {0, 20000000};
    const double began = seconds_of(CLOCK_MONOTONIC), day = seconds_of(CLOCK_REALTIME);
    double last = began;
    int back = 0;
    for (int i = 0; i < READINGS; i++) {
        const double now = seconds_of(CLOCK_MONOTONIC);
        back += now < last;
        last = now;
    }
    nanosleep(&nap, NULL);
    const double passed = seconds_of(CLOCK_MONOTONIC) - began,
                 drift = passed - (seconds_of(CLOCK_REALTIME) - day);
    if (back || passed < 0.019)
        fracas_patient_say(patient, FRACAS_WRONG,
                           "the monotonic clock went back %d times, and says that %.3g s took 20 "
                           "ms or more: leases would be killed at random; choose another "
                           "clocksource (/sys/devices/system/clocksource)",
                           back, passed);
    else if (fabs(drift) > 0.5)
        fracas_patient_say(patient, FRACAS_NOTED,
                           "the time of day jumped by %.3g s just now: times in segments and logs "
                           "will; does a time service run (chrony, ntpd)?",
                           drift);
    else
        fracas_patient_say(patient, FRACAS_SOUND, "the monotonic clock never went back in %d looks",
                           READINGS);
}

static void look_at_scratch(fracas_patient *patient)
{
    fracas_scratch scratch = FRACAS_SCRATCH_NONE;
    char room[FRACAS_SIZE_TEXT] = "", shared[FRACAS_SIZE_TEXT] = "";
    struct statvfs disk;
    const fracas_err err = fracas_scratch_create(&scratch);
    const bool has_shared = *scratch.shared.path && !statvfs(scratch.shared.path, &disk);
    if (has_shared) fracas_size_write((double)disk.f_bavail * (double)disk.f_frsize, shared);
    if (*scratch.session.path && !statvfs(scratch.session.path, &disk))
        fracas_size_write((double)disk.f_bavail * (double)disk.f_frsize, room);
    if (!fracas_patient_fails(patient, err)) {
        if (has_shared || !*scratch.session.path)
            fracas_patient_say(patient, FRACAS_SOUND,
                               "temporary files have %s, shared memory (/dev/shm) has %s", room,
                               shared);
        else
            fracas_patient_say(patient, FRACAS_NOTED,
                               "no folder can be made in /dev/shm: MPI keeps its shared memory "
                               "with temporary files, %s, which is slower; mount a tmpfs there",
                               room);
    }
    fracas_scratch_remove(&scratch);
}

const fracas_checkup fracas_checkups_machine[] = {
    {"program", look_at_program},  {"HDF5", look_at_hdf5},
    {"SQLite", look_at_sqlite},    {"PDF", look_at_pdf},
    {"cores", look_at_cores},      {"memory", look_at_memory},
    {"open files", look_at_files}, {"clock", look_at_clock},
    {"scratch", look_at_scratch},  {0}};
