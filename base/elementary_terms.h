/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Constants of log and exp, for one number at a time (base/elementary.c) and over lanes
 * (base/elementary_lanes.h). */
#ifndef FRACAS_BASE_ELEMENTARY_TERMS_H
#define FRACAS_BASE_ELEMENTARY_TERMS_H

#include <stdint.h>

/* ln 2 in two parts; the high one has 42 bits, which makes its product with an exponent exact. */
static const double ln2_hi = 0x1.62e42fefa3800p-1, ln2_lo = 0x1.ef35793c76730p-45;

/* The bits of sqrt(1/2). */
static const uint64_t sqrt_half = 0x3fe6a09e667f3bcd;

/* (2 artanh(s)/s - 2)/s^2 in s^2 <= 0.0295: 2^-60 */
static const double log_rest[8] = {
    0x1.5555555555555p-1, 0x1.9999999999a38p-2, 0x1.2492492476c87p-2, 0x1.c71c720160b47p-3,
    0x1.745cf901605f7p-3, 0x1.3b1c360763b8ap-3, 0x1.0fbe83c2cbcf3p-3, 0x1.0c04595972ab8p-3,
};

/* x log2_e + to_integer has the integer nearest to x/ln 2 in its lowest bits. */
static const double log2_e = 0x1.71547652b82fep+0, to_integer = 0x1.8p52;

/* (e^r - 1 - r)/r^2 in |r| <= 0.3467: 2^-60 */
static const double exp_rest[12] = {
    0x1.0000000000000p-1,  0x1.5555555555555p-3,  0x1.5555555555557p-5,  0x1.1111111111111p-7,
    0x1.6c16c16c15a5fp-10, 0x1.a01a01a0196a7p-13, 0x1.a01a01a9ed901p-16, 0x1.71de3a5aa9dc9p-19,
    0x1.27e4d40eb84dfp-22, 0x1.ae642c777eecbp-26, 0x1.1f7f3b37e9a58p-29, 0x1.61bfbf339abc9p-33,
};

#endif
