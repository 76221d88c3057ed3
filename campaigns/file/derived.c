/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "campaigns/file/derived.h"

#include "engine/mesh/body.h"

static double surface(const fracas_derivation *of)
{
    return fracas_spec_is_surface(&of->point->spec);
}

static double length(const fracas_derivation *of)
{
    return fracas_spec_length(&of->point->spec);
}

static double radius(const fracas_derivation *of)
{
    const fracas_spec *spec = &of->point->spec;
    return fracas_shape_of(spec)->round ? spec->geometry.radius : NAN;
}

/* Elements of equal length make every fragment a multiple of it. */
static double lattice(const fracas_derivation *of)
{
    const fracas_spec *spec = &of->point->spec;
    return fracas_spacing_of(spec)->uniform ? length(of) / (double)spec->mesh.elements : 0;
}

static double strain_rate(const fracas_derivation *of)
{
    return fracas_spec_strain_rate(&of->point->spec);
}

static double strength_mean(const fracas_derivation *of)
{
    return of->strength;
}

static double strength_modulus(const fracas_derivation *of)
{
    return fracas_strength_modulus(&of->point->strength, of->extent);
}

static double fracture_energy(const fracas_derivation *of)
{
    return fracas_spec_fracture_energy(&of->point->spec, of->strength);
}

const fracas_derived fracas_derived_columns[FRACAS_DERIVED] = {
    {{"derived.fracture_energy", "J/m2",
      "fracture energy G_c of the interfaces, at their mean strength", false},
     fracture_energy},
    {{"derived.lattice", "m",
      "length of which every fragment size is a multiple; 0 if there is none", false},
     lattice},
    {{"derived.length", "m", "length of a bar, circumference of a ring; NaN for a surface", false},
     length},
    {{"derived.radius", "m", "radius of a ring; NaN for other bodies", false}, radius},
    {{"derived.strain_rate", "1/s", "strain rate that the loading begins with", false},
     strain_rate},
    {{"derived.strength_mean", "Pa", "mean of the distribution of strengths", false},
     strength_mean},
    {{"derived.strength_modulus", "1", "modulus M of the strengths in Mott's law; NaN without one",
      false},
     strength_modulus},
    {{"derived.surface", "1", "1 if the body is a surface, else 0", false}, surface},
};

void fracas_derived_reference(FILE *out)
{
    fputs("| dataset | unit | meaning |\n|---|---|---|\n", out);
    for (int d = 0; d < FRACAS_DERIVED; d++) {
        const fracas_column *column = &fracas_derived_columns[d].column;
        fprintf(out, "| `/point/%s` | %s | %s |\n", column->path, column->unit, column->doc);
    }
}
