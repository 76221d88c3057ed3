/* SPDX-License-Identifier: GPL-3.0-or-later */
/* System calls of a library that watches those of the program: a seccomp filter lets them pass by a
 * mark in the sixth argument. */
#ifndef FRACAS_TESTS_SUPPORT_OWN_CALLS_H
#define FRACAS_TESTS_SUPPORT_OWN_CALLS_H

#include <errno.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <signal.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <sys/prctl.h>
#include <sys/syscall.h>

static const uint64_t OURS = 0x66726163617321;
/* The result, or -errno. */
static inline long really(long number, long a, long b, long c, long d, long e)
{
    long result;
    register long r10 __asm__("r10") = d;
    register long r8 __asm__("r8") = e;
    register long r9 __asm__("r9") = (long)OURS;
    __asm__ volatile("syscall"
                     : "=a"(result)
                     : "a"(number), "D"(a), "S"(b), "d"(c), "r"(r10), "r"(r8), "r"(r9)
                     : "rcx", "r11", "memory");
    return result;
}

/* The end of a filter: a jump to its second line traps the call, unless it is ours. */
enum { OWN_TAIL = 7, OWN_SIXTH = offsetof(struct seccomp_data, args[5]) };
static inline void own_tail(struct sock_filter *line)
{
    const struct sock_filter tail[OWN_TAIL] = {
        BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW),
        BPF_STMT(BPF_LD | BPF_W | BPF_ABS, OWN_SIXTH),
        BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, (uint32_t)OURS, 0, 2),
        BPF_STMT(BPF_LD | BPF_W | BPF_ABS, OWN_SIXTH + 4),
        BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, (uint32_t)(OURS >> 32), 1, 0),
        BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_TRAP),
        BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW)};
    for (int l = 0; l < OWN_TAIL; l++) line[l] = tail[l];
}

/* False, and errno, if the system refuses. */
static inline bool own_install(struct sock_filter *filter, size_t lines)
{
    struct sock_fprog program = {(unsigned short)lines, filter};
    return !prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) &&
           !prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program);
}

#endif
