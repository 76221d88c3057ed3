/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Surfaces of triangles without common nodes: the common part of membranes and shells
 * (docs/theory/membrane.md).
 *
 * The bodies differ in strains, fluxes, jumps and inertia. A body describes itself to the host by a
 * fracas_surface_body, and to the sweep by its kernel (engine/formulation/surface/kernel.h).
 *
 * State of a group of lanes, one part after another:
 *   [element][field][lane]    SURFACE_U ..., each as wide as an element has unknowns (node 0 x, y,
 *                             ..., node 1 x, ...)
 *   [interface][point][field][lane]  values of the law (engine/cohesive/law.h)
 *   [strength][lane]          sigma_c [Pa], one for each interface, or for each of its Gauss points
 * and then, for the sweep alone and of no meaning between steps
 *   [ghost][field][lane]      each part's copies of elements and interfaces (division.h)
 *   [slot][field][lane]       each part's: stresses and forces of an element under way
 *   [block][sum][lane]        SURFACE_STRAIN ..., of SURFACE_BLOCK consecutive elements each
 */
#ifndef FRACAS_ENGINE_FORMULATION_SURFACE_SURFACE_H
#define FRACAS_ENGINE_FORMULATION_SURFACE_SURFACE_H

#include "base/hash.h"
#include "base/isa.h"
#include "engine/cohesive/law.h"
#include "engine/element/triangle.h"
#include "engine/formulation/formulation.h"
#include "engine/formulation/surface/division.h"
#include "engine/loading/load.h"
#include "engine/mesh/surface/surface.h"

/* By the order of triangles: nodes, bulk points (of stresses), Gauss points of an edge. */
#define SURFACE_NODES(order) (3 * (order))
#define SURFACE_BULK(order) ((order) == 1 ? 1 : 3)
#define SURFACE_EDGE(order) ((order) + 1)
/* At most: points of an interface at which a law acts, unknowns of an element. */
enum { SURFACE_POINTS_MOST = 9, SURFACE_UNKNOWNS_MOST = 18 };

/* Fields of an element, each as wide as it has unknowns: displacement at t_n; velocity, half a step
 * behind before the sweep and ahead after (Hulbert-Chung: at t_n); Hulbert-Chung: acceleration a_n
 * and a_{n+1}. */
enum {
    SURFACE_U,
    SURFACE_V,
    SURFACE_FIELDS,
    SURFACE_A = SURFACE_FIELDS,
    SURFACE_A_NEXT,
    SURFACE_FIELDS_ALPHA
};

/* Sums over a block, for the ledger. Elements and interfaces add one after another, an interface to
 * the block of its second element; then blocks are added by a fixed tree. So no sum depends on who
 * computes which blocks. First those that follow the turns of elements, then those of their kicks.
 */
enum {
    SURFACE_STRAIN,     /* twice the strain energy [J] */
    SURFACE_RIMS,       /* twice the energy of rims [J] */
    SURFACE_FLUX,       /* twice the energy of the flux [J] */
    SURFACE_STORED,     /* twice the energy of openings and contact [J] */
    SURFACE_DISSIPATED, /* energy dissipated so far [J] */
    SURFACE_BENDING,    /* energy dissipated by bending in this step [J] */
    SURFACE_CREATED,    /* energy put in by onsets and breaks in this step [J] */
    SURFACE_RUBBED,     /* energy dissipated by friction in this step [J] */
    SURFACE_SUMS_BY_TURN,
    SURFACE_KINETIC = SURFACE_SUMS_BY_TURN, /* twice the kinetic energy [J] */
    SURFACE_DAMPED,                         /* energy damped in this step [J] */
    SURFACE_MOMENT,                         /* membranes: sum of m r.du/dt of this step [kg m2/s] */
    SURFACE_WORK,                           /* work of loads in this step [J] */
    SURFACE_POWER,                          /* power of reactions [W]; where loads move nodes:
                                               of each motion the force along its path [N] */
    SURFACE_SUMS = SURFACE_POWER + FRACAS_LOADINGS
};
enum { SURFACE_BLOCK = 64 }; /* elements */

/* Head of a bulk point's table: derivatives of xi, eta along x, y, and the weight: of quadrature
 * times area, or times volume where stresses are no resultants. */
enum {
    SURFACE_XI_X,
    SURFACE_XI_Y,
    SURFACE_ETA_X,
    SURFACE_ETA_Y,
    SURFACE_WEIGHT,
    SURFACE_BULK_HEAD
};

/* Head of an interface's table: stiffness K [Pa/m], its inverse. */
enum { SURFACE_STIFFNESS, SURFACE_COMPLIANCE, SURFACE_HEAD };

typedef struct fracas_surface_body fracas_surface_body;

/* An element's rotary inertia: the direction t along which displacements turn it, and two symmetric
 * matrices over its nodes, lower triangles row by row: R [kg], and the part of the inverse mass
 * beside M^-1 [1/kg]  (shell.17). */
enum {
    SURFACE_TURNING,
    SURFACE_ROTARY = SURFACE_TURNING + 3,
    SURFACE_ROTARY_INVERSE = SURFACE_ROTARY + 21,
    SURFACE_ROTARY_TABLE = SURFACE_ROTARY_INVERSE + 21
};
static inline int fracas_surface_entry(int row, int column)
{
    return row < column ? column * (column + 1) / 2 + row : row * (row + 1) / 2 + column;
}

/* The mesh as the sweep reads it: one copy for all lanes and realizations. The body lays out the
 * tables of bulk points and interfaces. */
typedef struct {
    const fracas_surface_body *body;
    int order;
    size_t nelements, ninterfaces;
    double *bulk;       /* [element][bulk point][body->bulk_table] */
    double *lumped;     /* [element]: of each node 1/mass [1/kg], then of each the mass [kg] */
    double *consistent; /* [element][3][node][node]: inverse for x, for y, with rows and columns of
                           held nodes 0 [1/kg], and the mass itself [kg]; NULL: masses are lumped */
    double *rotary;     /* [element][SURFACE_ROTARY_TABLE]; NULL: there is no rotary inertia */
    double *position;   /* [element][node][2] [m]; NULL: the loading does not need it */
    double *interface;  /* [interface]: head, then [Gauss point][body->point_table] */
    uint32_t (*element)[2]; /* [interface] */
    uint8_t (*edge)[2];     /* [interface]: which of its elements' edges */
    uint32_t *held, *fixed; /* [element]: bit dimension node + component: velocity held; at 0 */
    bool moves;             /* some edge is held, and not fixed */
    /* Elements under loads, with their forces at amplitude 1, load after load  (loads.3) */
    int forces, force[FRACAS_LOADINGS]; /* loads that are forces: numbers of their loadings */
    size_t nloads;
    uint32_t *load_row; /* [load][element]: its row + 1; 0: none; NULL: there is no load */
    double *load;       /* [row][unknown] [N] */
    fracas_load_clock *load_clock;           /* [row] */
    fracas_profile history[FRACAS_LOADINGS]; /* by loading */
    /* Elements with nodes that a load moves, u = s(t) d  (loads.5) */
    int motions, motion[FRACAS_LOADINGS]; /* loads that do: numbers of their loadings */
    size_t nmoved;
    uint32_t *moved;     /* [element]: bits as of `held`, among them; NULL: no node is moved */
    uint32_t *moved_row; /* [element]: its row + 1; 0: none */
    uint8_t *moved_by;   /* [row]: by which motion */
    double *direction;   /* [row][unknown]: d, 0 of components not moved */
    double *start;       /* [row][unknown]: u_0 [m]; NULL: 0 */
    int sets;            /* number of sets of nodes that loads hold */
    uint32_t *set;       /* [set][element]: bits as of `held`: what it holds, and no edge does */
    /* A shell's edges whose director is held. */
    size_t nrims;
    double *rim;        /* [rim][body->rim_table] */
    uint8_t *rim_edge;  /* [rim]: which of its element's edges */
    uint32_t *rim_from; /* [element]: its rims are rim_from[e] to rim_from[e + 1] - 1 */
} fracas_surface_tables;

typedef struct {
    int alpha;              /* Hulbert-Chung, with its parameters; else central difference */
    double alpha_m, b, g;   /* 1 */
    double excess, damping; /* 1 */
    double root;            /* 1: sqrt((1 - alpha_m)/2) */
} fracas_surface_motion;

/* Input of a sweep, the same for all lanes. */
typedef struct fracas_surface_constants {
    const fracas_surface_tables *tables;
    double thickness;     /* m */
    double c11, c12, c33; /* E/(1-nu^2), nu c11, E/(2 + 2 nu) [Pa]; shells: times thickness [N/m] */
    double d11, d12, d33; /* shells: thickness^2/12 of those [N m] */
    double normal, tangential; /* k_n/K and k_t/K of the interface, 1  (membrane.6) */
    double energy, opening;    /* G_c [J/m2], or 2 G_c/p [m]: the other is 0 */
    double beta_c, mu_c;       /* 1 */
    int law;                   /* its number */
    const double *own;         /* its own numbers (trait `own`) */
    int onset_mean, friction;
    int fields, point_fields; /* an element's, by its unknowns; an interface's point's */
    int strengths;            /* an interface's: 1, or one for each Gauss point */
    double speed, ramp;       /* rad/s, s: w = speed min(1, t/ramp) */
    const fracas_loading *force[FRACAS_LOADINGS];  /* loads that are forces, tables->forces */
    const fracas_loading *moving[FRACAS_LOADINGS]; /* loads that move nodes, tables->motions */
    int strained; /* the body starts with a strain, and so with accelerations */
    fracas_surface_motion motion;
    int contact; /* the operator: all interfaces broken and in contact; else whole */
} fracas_surface_constants;

/* One lane's view of an interface. */
typedef struct {
    double u[2][SURFACE_UNKNOWNS_MOST]; /* displacements of its two elements [m] */
    double fields[SURFACE_POINTS_MOST * SURFACE_POINT_FIELDS_MOST]; /* [point][field] of the law */
    double strength[SURFACE_EDGE(2)];                               /* at its Gauss points [Pa] */
    /* At each point: traction held against the strength, opening over that of the break; 1 at the
     * onset, at the break. */
    double onset[SURFACE_POINTS_MOST], opening[SURFACE_POINTS_MOST];
} fracas_surface_view;
/* Fills the last two from the rest. */
typedef void fracas_surface_inspect(const fracas_surface_constants *constants, size_t interface,
                                    fracas_surface_view *view);

/* Strain energy of an element with displacements u [J], and its stresses at the bulk points,
 * [point][body->stresses]; NULL: they are not wanted. */
typedef double fracas_surface_strain(const fracas_surface_constants *constants, size_t element,
                                     double *u, double *stress);

/* Number of the linear operator's sweep, after those of the laws. */
enum { SURFACE_OPERATOR = FRACAS_LAWS, SURFACE_SWEEPS };

/* Advances the lanes first .. first + lanes - 1 of a part. */
typedef void fracas_surface_sweep(const fracas_surface_constants *constants, fracas_step *step,
                                  int first, size_t part);

/* A unit: [law][order - 1]. Units of one lane alone have the operator's sweep, which leaves
 * M^-1 (-f)(u) where velocities are, views and strain energies. */
typedef struct {
    fracas_surface_sweep *sweep[SURFACE_SWEEPS][2];
    fracas_surface_inspect *look[2];
    fracas_surface_strain *strain[2];
} fracas_surface_kernel;
typedef const fracas_surface_kernel
    *const fracas_surface_kernels[FRACAS_NISAS][FRACAS_LANES_MAX + 1];

/* A body: the traits of its formulation. Its functions fill tables of the caller's. */
struct fracas_surface_body {
    int dimension;       /* components of a displacement */
    int stresses;        /* values of stress at a bulk point */
    int layers;          /* points through the thickness at each Gauss point of an interface */
    const double *layer; /* [layers]: their weights, of sum 1 */
    bool resultants;     /* stresses are integrals over the thickness */
    size_t bulk_table, head, point_table, rim_table; /* doubles; no rims: 0 */
    const fracas_surface_kernels *kernels;
    /* FRACAS_USAGE for a mesh unfit for this body; before and after its tables are filled. */
    fracas_err (*check_mesh)(const fracas_surface *surface);
    fracas_err (*check_tables)(const fracas_model *model); /* NULL: nothing to check */
    /* A bulk point at xi, eta of an element, of quadrature weight `weight`. */
    void (*fill_bulk)(const fracas_model *model, size_t element, double xi, double eta,
                      double weight, double *bulk);
    /* Head of an interface but for its compliance; `inverse_size` is 1/h_s [1/m]. */
    void (*fill_head)(const fracas_model *model, double inverse_size, double *head);
    /* Its Gauss point at s of the first element's edge, of quadrature weight `weight`. */
    void (*fill_point)(const fracas_model *model, const fracas_surface_interface *interface,
                       double s, double weight, double *point);
    void (*fill_rim)(const fracas_model *model, const fracas_surface_border *border, double *rim);
    /* Direction t and matrix R of an element's whole rotary inertia; NULL: the body has none. */
    void (*fill_rotary)(const fracas_model *model, size_t element, double t[3], double *rotary);
    /* The axis across the plane x, y or z = const of an edge, as a bit, of two the one nearer to
     * the edge's own normal; 0: there is none, or its cosine with that is below `least`. */
    unsigned (*edge_axis)(const fracas_surface *surface, const fracas_surface_border *border,
                          double least);
    /* Turns the stresses of a bulk point, by its table, into tensors in space: xx, yy, zz, xy, yz,
     * xz of each three. */
    void (*turn_stress)(const double *bulk, const double *stress, double *tensor);
    /* Normal of an interface at a Gauss point, by its table. */
    void (*normal)(const double *point, double normal[3]);
    /* Adds node k of an element to its fragment's sums, with its inertia in the sweep; x and v
     * are those of all its nodes [m], [m/s]. */
    void (*add_node)(const fracas_surface_tables *tables, size_t element, size_t k,
                     const double (*x)[3], const double (*v)[3], fracas_fragment_sums *sums);
};

/* Sizes and places in a group's state, in units of one field's lanes. */
static inline size_t fracas_surface_unknowns(const fracas_surface_tables *t)
{
    return (size_t)(t->body->dimension * SURFACE_NODES(t->order));
}
static inline size_t fracas_surface_points(const fracas_surface_tables *t)
{
    return (size_t)(SURFACE_EDGE(t->order) * t->body->layers);
}
static inline size_t fracas_surface_element_fields(const fracas_surface_constants *c)
{
    return (size_t)c->fields * fracas_surface_unknowns(c->tables);
}
static inline size_t fracas_surface_interface_fields(const fracas_surface_constants *c)
{
    return fracas_surface_points(c->tables) * (size_t)c->point_fields;
}
static inline size_t fracas_surface_interfaces_at(const fracas_surface_constants *c)
{
    return c->tables->nelements * fracas_surface_element_fields(c);
}
static inline size_t fracas_surface_strengths_at(const fracas_surface_constants *c)
{
    return fracas_surface_interfaces_at(c) +
           c->tables->ninterfaces * fracas_surface_interface_fields(c);
}
static inline size_t fracas_surface_state_fields(const fracas_surface_constants *c)
{
    return fracas_surface_strengths_at(c) + c->tables->ninterfaces * (size_t)c->strengths;
}
/* A slot: stresses at the bulk points, strains added there by symmetrisation, forces. */
static inline size_t fracas_surface_slot(const fracas_surface_tables *t)
{
    return (size_t)(2 * t->body->stresses * SURFACE_BULK(t->order)) + fracas_surface_unknowns(t);
}
static inline size_t fracas_surface_blocks(const fracas_surface_tables *t)
{
    return (t->nelements + SURFACE_BLOCK - 1) / SURFACE_BLOCK;
}
/* Number of the strength at Gauss point g of an interface. */
static inline size_t fracas_surface_strength_of(const fracas_surface_constants *c, size_t interface,
                                                int g)
{
    return interface * (size_t)c->strengths + (c->strengths > 1 ? (size_t)g : 0);
}

/* M_kl of the lumped or consistent masses of element e [kg]. */
static inline double fracas_surface_mass(const fracas_surface_tables *t, size_t e, size_t k,
                                         size_t l)
{
    const size_t nodes = (size_t)SURFACE_NODES(t->order);
    if (t->consistent) return t->consistent[((3 * e + 2) * nodes + k) * nodes + l];
    return k == l ? t->lumped[(2 * e + 1) * nodes + k] : 0;
}

/* Tables of model->surface and model->spec, checked. The caller destroys. */
FRACAS_MUST_USE fracas_err fracas_surface_tables_create(const fracas_model *model,
                                                        fracas_surface_tables **tables);
/* Components that hold each node of a border's edge, as bits; 0: it is free. */
unsigned fracas_surface_held_by(const fracas_model *model, const fracas_surface_border *border);
void fracas_surface_tables_destroy(void *tables); /* NULL is allowed */
size_t fracas_surface_tables_bytes(const fracas_surface_tables *tables);
/* Equal for equal tables of the linear operator. */
fracas_hash fracas_surface_tables_hash(const fracas_surface_tables *tables);

fracas_surface_constants fracas_surface_constants_of(const fracas_model *model);

/* Where the state of lane `lane` has a field, counted from the start of its group's. */
double *fracas_surface_field(const fracas_step *step, size_t field, int lane);
/* The operator K of all interfaces whole, or all broken and pressed together:
 *   acceleration = -M^-1 K u, for [element][unknown]; held components: 0
 * `apply` may be called any number of times between open and close. */
typedef struct fracas_surface_operator fracas_surface_operator;
FRACAS_MUST_USE fracas_err fracas_surface_operator_open(const fracas_model *model, int contact,
                                                        fracas_surface_operator **op);
void fracas_surface_operator_apply(fracas_surface_operator *op, const double *u,
                                   double *acceleration);
void fracas_surface_operator_close(fracas_surface_operator *op); /* NULL is allowed */
FRACAS_OWNER(fracas_surface_operator, fracas_surface_operator_close)

/* The model's critical steps, dt_c = Omega_c/omega_max of both operators  (membrane.16). */
FRACAS_MUST_USE fracas_err fracas_surface_critical_step(fracas_model *model);

/* 1/h_s = (|e|/A- + |e|/A+)/2 of an interface [1/m]  (membrane.5) */
double fracas_surface_inverse_size(const fracas_surface *surface, size_t interface);

/* ---- sums ---- */

/* w(t)^2, w = speed min(1, t/ramp): 0 where no body force acts [1/s2]. */
double fracas_surface_spin(const fracas_surface_constants *constants, double time);
/* s(t) of a motion, 0 to tables->motions - 1 [m]  (loads.6) */
double fracas_surface_path(const fracas_surface_constants *constants, int motion, double time);
/* After a sweep: sums of all blocks to energies [J], those of the potential (membrane.8),
 * (shell.11), power [W] and work [J]. */
void fracas_surface_totals(const fracas_surface_constants *constants, fracas_step *step);

/* ---- events: onset and break of points within a step, lane by lane; they are rare ---- */

typedef struct {
    size_t interface;
    int lane;                 /* the step's */
    const double *element[2]; /* its elements' fields in that lane ... */
    const double *fields;     /* ... and its own */
    int cracks[SURFACE_POINTS_MOST], breaks[SURFACE_POINTS_MOST]; /* by point */
    int opens, parts; /* the interface's first point cracks, its last one breaks */
} fracas_surface_event;

/* Counts an event, and keeps the times interpolated between the step before and this one
 * (membrane.12). Parts may call it at once. */
void fracas_surface_record_event(const fracas_surface_constants *constants, fracas_step *step,
                                 const fracas_surface_event *event);

/* ---- points of elements ---- */

/* Values of the shape functions, place [m], dx/dxi and dx/deta [m] of element e at (xi, eta). */
void fracas_surface_at(const fracas_surface *surface, size_t e, double xi, double eta,
                       double shape[6], double place[3], double base[2][3]);

/* ---- start ---- */

/* By the section `initial`: velocity [m/s], 0 of held components, and displacement [m] of unknown i
 * of element e  (initial.1), (initial.4) */
double fracas_surface_initial_velocity(const fracas_model *model, size_t e, size_t i);
double fracas_surface_initial_displacement(const fracas_model *model, size_t e, size_t i);
/* FRACAS_USAGE for stresses in a bent body, strains across a flat one, velocities of no node, half
 * waves shorter than two edges, and velocities or shear across a plane of symmetry. */
FRACAS_MUST_USE fracas_err fracas_surface_check_initial(const fracas_model *model);

/* ---- broken interfaces ---- */

/* All its points are. */
bool fracas_surface_is_broken(const fracas_surface_constants *constants, const fracas_step *step,
                              size_t interface, int lane);
/* An interface as a record has it; times are NaN where none are kept. */
fracas_interface_row fracas_surface_interface_row(const fracas_model *model,
                                                  const fracas_surface_constants *constants,
                                                  const fracas_step *step, size_t interface,
                                                  int lane);

/* ---- functions of the formulations ---- */

FRACAS_MUST_USE fracas_err fracas_surface_model_init(fracas_model *model);
void fracas_surface_part_notch(fracas_model *model);
FRACAS_MUST_USE fracas_err fracas_surface_check_strength(const fracas_model *model,
                                                         double strength);
double fracas_surface_interface_volume(const fracas_model *model, size_t interface);
size_t fracas_surface_state_size(const fracas_model *model);
size_t fracas_surface_parts_most(const fracas_model *model);
FRACAS_MUST_USE fracas_err fracas_surface_model_divide(const fracas_model *model, size_t parts,
                                                       fracas_division *division);
double *fracas_surface_strength(const fracas_model *model, const fracas_step *step, int lane,
                                size_t *stride);
void fracas_surface_lane_init(const fracas_model *model, const fracas_step *step, int lane);
void fracas_surface_advance(const fracas_model *model, fracas_step *step);
FRACAS_MUST_USE fracas_err fracas_surface_count(const fracas_model *model, fracas_step *step,
                                                int lane, fracas_census *census);
size_t fracas_surface_partition(const fracas_model *model, fracas_step *step, int lane);
void fracas_surface_add_up(const fracas_model *model, const fracas_step *step, int lane,
                           const fracas_fragment_motion *motion, fracas_fragment_sums *sums);
FRACAS_MUST_USE fracas_err fracas_surface_harvest(const fracas_model *model, fracas_step *step,
                                                  int lane, fracas_record *record);

void fracas_surface_add_matter(const fracas_model *model, const fracas_step *step, int lane,
                               const uint32_t *element, size_t count,
                               fracas_fragment_matter *matter, double (*node)[3]);
void fracas_surface_add_cracks(const fracas_model *model, const fracas_step *step, int lane,
                               fracas_fragment *fragment);
size_t fracas_surface_element_nodes(const fracas_model *model);
size_t fracas_surface_interface_nodes(const fracas_model *model);
void fracas_surface_fields(const fracas_model *model, const fracas_step *step, int lane,
                           fracas_fields *fields);
/* Fills the holds of a division. */
FRACAS_MUST_USE fracas_err fracas_surface_holds_fill(const fracas_model *model,
                                                     fracas_surface_division *division);
size_t fracas_surface_held_edges(const fracas_model *model, int64_t tag[FRACAS_HOLDERS]);
void fracas_surface_reactions(const fracas_model *model, const fracas_step *step, int lane,
                              double (*force)[3]);
/* The point of element e at `place`; false if the element is elsewhere. */
bool fracas_surface_has(const fracas_surface *surface, size_t e, const double place[3],
                        fracas_spot *spot);
void fracas_surface_locate(const fracas_model *model, const double place[3], fracas_spot *spot);
void fracas_surface_motion_at(const fracas_model *model, const fracas_step *step, int lane,
                              const fracas_spot *spot, double displacement[3], double velocity[3]);

/* All members of a formulation of surfaces but `stress` and `kind`, whose traits are the body. */
#define FRACAS_SURFACE_FORMULATION                                                              \
    .model_init = fracas_surface_model_init, .part_notch = fracas_surface_part_notch,           \
    .check_strength = fracas_surface_check_strength,                                            \
    .interface_volume = fracas_surface_interface_volume,                                        \
    .plan_destroy = fracas_surface_tables_destroy, .state_size = fracas_surface_state_size,     \
    .parts_most = fracas_surface_parts_most, .divide = fracas_surface_model_divide,             \
    .division_destroy = fracas_surface_division_destroy, .strength = fracas_surface_strength,   \
    .lane_init = fracas_surface_lane_init, .advance = fracas_surface_advance,                   \
    .count = fracas_surface_count, .partition = fracas_surface_partition,                       \
    .add_up = fracas_surface_add_up, .harvest = fracas_surface_harvest,                         \
    .element_nodes = fracas_surface_element_nodes, .add_matter = fracas_surface_add_matter,     \
    .add_cracks = fracas_surface_add_cracks, .interface_nodes = fracas_surface_interface_nodes, \
    .fields = fracas_surface_fields, .locate = fracas_surface_locate,                           \
    .motion_at = fracas_surface_motion_at, .held_edges = fracas_surface_held_edges,             \
    .reactions = fracas_surface_reactions

#endif
