/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Undefines the names of shell_interface_template.h. */
#undef shell_sides_of
#undef shell_turn
#undef shell_resultants
#undef shell_flux
#undef shell_flux_energy
#undef shell_give
#undef shell_give_side
#undef shell_rim
#undef shell_crack
#undef shell_layers_point
#undef shell_book
#undef shell_join
#undef shell_layers
#undef shell_booked
#undef shell_point
#undef shell_sides
