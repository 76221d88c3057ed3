/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Any bytes as the file that a sound campaign names (tests/fuzz/campaign.h). The input: a digit
 * that chooses the campaign, then the file. For libFuzzer (tools/fuzz), and the corpus as a test.
 */
#include "tests/fuzz/campaign.h"

#define CHAIN                                                                                \
    "name: a\nseed: 1\nmodel: %s\nmesh: {elements: 3}\nmaterial: {young: 275 GPa, density: " \
    "2750}\ncohesive: {law: nitsche, fracture_energy: 100}\ntime: {stop: time, end: 1 us, "  \
    "safety: 0.1}\nreplicas: 1\nstrength: {distribution: file, file: attached}\n"
#define SURFACE                                                                              \
    "name: a\nseed: 1\nmodel: %s\nmaterial: {young: 275 GPa, density: 2750, poisson: 0.2}\n" \
    "cohesive: {law: nitsche, fracture_energy: 1e6}\nloading: {type: expansion, rate: "      \
    "1e4}\ntime: {stop: time, end: 1 us, safety: 0.1}\nreplicas: 1\n"
#define MESHED                                                                          \
    "geometry: {shape: file, file: attached, thickness: 1 mm, edges: held}\n"           \
    "mesh: {spacing: given}\nstrength: {distribution: weibull, scale: 300 MPa, shape: " \
    "5}\n"
#define PLACED                                                                         \
    "geometry: {width: 2 mm, height: 1 mm, thickness: 0.1 mm}\nmesh: {divisions: 1}\n" \
    "strength: {distribution: %s, file: attached}\n"

/* Text of campaign `which`. */
static void write_campaign(unsigned which, char *text, size_t size)
{
    static const char *const chain[] = {
        CHAIN "geometry: {ends: periodic, length: 1 mm, area: 1e-6}\nloading: {type: "
              "imposed-rate, rate: 1e4}\n",
        CHAIN "geometry: {ends: held, length: 1 mm, area: 1e-6}\nloading: {type: imposed-rate, "
              "rate: 1e4}\n",
        CHAIN "geometry: {radius: 1 mm, area: 1e-6}\nloading: {type: initial-velocity, radial: "
              "10}\n"};
    switch (which) {
    case 0:
    case 1:
    case 2: snprintf(text, size, chain[which], which == 2 ? "ring" : "bar"); return;
    case 3: snprintf(text, size, SURFACE PLACED, "membrane", "file"); return;
    case 4: snprintf(text, size, SURFACE PLACED, "membrane", "positions"); return;
    case 5: snprintf(text, size, SURFACE MESHED, "membrane"); return;
    default: snprintf(text, size, SURFACE MESHED, "shell"); return;
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    char text[1000];
    if (size == 0) return 0;
    campaign_start();
    write_campaign(data[0] & 7, text, sizeof text);
    write_named("c.yaml", text, strlen(text));
    write_named("attached", data + 1, size - 1);
    check_campaign();
    return 0;
}
