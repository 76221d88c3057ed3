/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What drives the body: the section `loading`. */
#ifndef FRACAS_ENGINE_LOADING_LOADING_H
#define FRACAS_ENGINE_LOADING_LOADING_H

#include "engine/spec.h"

extern const fracas_section fracas_loading_section;
extern const fracas_kind fracas_loading_imposed_rate, fracas_loading_initial_velocity,
    fracas_loading_held_velocity, fracas_loading_force, fracas_loading_expansion,
    fracas_loading_centrifugal;
extern const fracas_kind fracas_start_moving, fracas_start_rest;
extern const fracas_kind fracas_axis_radial, fracas_axis_circumferential;

#endif
