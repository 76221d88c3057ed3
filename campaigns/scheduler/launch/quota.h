/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Processor time allowed by the control groups of this process, as `docker run --cpus 2` or a
 * batch system sets it. */
#ifndef FRACAS_CAMPAIGNS_SCHEDULER_LAUNCH_QUOTA_H
#define FRACAS_CAMPAIGNS_SCHEDULER_LAUNCH_QUOTA_H

#define FRACAS_QUOTA_GROUPS "/proc/self/cgroup"
#define FRACAS_QUOTA_MOUNT "/sys/fs/cgroup"

/* min over the groups of `groups` and all above them of quota/period [cores]; INFINITY if none has
 * a quota. `groups`: a file as /proc/PID/cgroup (cgroups(7)); `mount`: where the file systems of
 * the groups are, versions 1 (cpu.cfs_quota_us over cpu.cfs_period_us) and 2 (cpu.max). An
 * unreadable file has no quota. */
double fracas_quota_cores(const char *groups, const char *mount);

#endif
