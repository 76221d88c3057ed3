/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "engine/mesh/edge.h"

#include <stdio.h>
#include <string.h>

static unsigned all_of(unsigned all, unsigned across)
{
    (void)across;
    return all;
}

static unsigned across_alone(unsigned all, unsigned across)
{
    return all & across;
}

static unsigned within_alone(unsigned all, unsigned across)
{
    return all & ~across;
}

const fracas_kind fracas_edge_free = {
    "free", "nothing holds the edge",
    .traits = &(const fracas_edge){.models = FRACAS_GROUP_SURFACES}};

const fracas_kind fracas_edge_held = {
    "held",
    "the edge moves with the velocity of the loading all the time: that of the expansion, "
    "or none; a shell may turn about it",
    .traits = &(const fracas_edge){
        .models = FRACAS_GROUP_SURFACES, .holds = all_of, .moving = true}};

const fracas_kind fracas_edge_sliding = {
    "sliding", "membranes: as held, but free to slide along itself; an edge along x or y only",
    .traits = &(const fracas_edge){
        .models = FRACAS_GROUP_MEMBRANE, .holds = across_alone, .plane = true, .moving = true}};

const fracas_kind fracas_edge_fixed = {
    "fixed", "the edge stays where it is; a shell may turn about it",
    .traits = &(const fracas_edge){.models = FRACAS_GROUP_SURFACES, .holds = all_of}};

const fracas_kind fracas_edge_clamped = {
    "clamped", "shells: the edge stays where it is and does not turn",
    .traits = &(const fracas_edge){
        .models = FRACAS_GROUP_SHELL, .holds = all_of, .director = true}};

const fracas_kind fracas_edge_symmetry = {
    "symmetry",
    "the edge lies in a plane x, y or z = const, and what is beyond is the mirror image; a shell "
    "does not turn about it",
    .traits = &(const fracas_edge){.models = FRACAS_GROUP_SURFACES,
                                   .holds = across_alone,
                                   .plane = true,
                                   .mirror = true,
                                   .director = true}};

const fracas_kind fracas_edge_diaphragm = {
    "diaphragm",
    "shells: the edge lies in a plane x, y or z = const and does not move in it; it may "
    "leave it, and the shell turn about it",
    .traits = &(const fracas_edge){
        .models = FRACAS_GROUP_SHELL, .holds = within_alone, .plane = true}};

const fracas_kind *const fracas_edge_kinds[FRACAS_EDGE_KINDS] = {
    &fracas_edge_free,    &fracas_edge_held,     &fracas_edge_sliding,  &fracas_edge_fixed,
    &fracas_edge_clamped, &fracas_edge_symmetry, &fracas_edge_diaphragm};

const char *fracas_edge_names(unsigned group, char text[120])
{
    int last = 0, used = 0;
    for (int k = 0; k < FRACAS_EDGE_KINDS; k++)
        if (fracas_edge_of(fracas_edge_kinds[k])->models & group) last = k;
    text[0] = '\0';
    for (int k = 0; k <= last && used < 120; k++) {
        const fracas_kind *kind = fracas_edge_kinds[k];
        if (!(fracas_edge_of(kind)->models & group)) continue;
        used += snprintf(text + used, 120 - (size_t)used, "%s%s",
                         used == 0   ? ""
                         : k == last ? " or "
                                     : ", ",
                         kind->name);
    }
    return text;
}
