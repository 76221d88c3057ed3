/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Names in other programs for things beyond fracas, between spaces and in small letters; and the
 * nearest thing here. docs/limits.md says more.
 * X(words, sentence) */
#define FRACAS_ABSENT(X)                                                                           \
    X("yield yield_stress yield_strength hardening plastic plasticity elastoplastic j2 von_mises " \
      "johnson_cook ductile bilinear",                                                             \
      "bodies are elastic until they crack, and nothing flows: what comes nearest is a cohesive "  \
      "law with the whole fracture energy")                                                        \
    X("damage gurson viscous viscosity viscoelastic visco kelvin maxwell rate_dependent damping "  \
      "rayleigh",                                                                                  \
      "bodies are elastic and without damping until they crack: a law with softening comes "       \
      "nearest to damage, time.integrator hulbert-chung to damping")                               \
    X("orthotropic anisotropic composite laminate layers fiber fibers",                            \
      "materials are isotropic and of one layer: strengths can vary over space")                   \
    X("temperature thermal heat conductivity expansion_coefficient cooling quench",                \
      "no heat flows: initial.temperature, with initial.expansion_coefficient, is a jump of it")   \
    X("prestress residual_stress initial_stress initial_strain pretension",                        \
      "stresses and strains at the start are initial.stress_x, initial.strain_x and their kin")    \
    X("solid 3d volume tetrahedra tetrahedron hexahedra brick box cube block cone",                \
      "bodies are thin: a shell, in space, comes nearest to a solid")                              \
    X("beam truss frame",                                                                          \
      "lines do not bend out of their direction: a bar or ring comes nearest, or a narrow shell")  \
    X("finite large nonlinear neo_hookean hyperelastic corotational buckling",                     \
      "displacements are small and stiffness is that of the start: nothing buckles or folds")      \
    X("impact impactor projectile indenter obstacle drop collision plate_impact",                  \
      "nothing from outside touches a body: a pressure or traction of known history comes "        \
      "nearest; bars have walls, by geometry.gap")                                                 \
    X("blast explosion explosive detonation friedlander jwl",                                      \
      "nothing burns: give the pressure by type pressure, with decay, duration or history")        \
    X("gravity acceleration weight", "a constant acceleration is type body-force")                 \
    X("sph dem peridynamics phase_field xfem mesh_free meshfree particles",                        \
      "cracks run between elements: bodies are bars, rings, membranes and shells")
