/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "engine/integrator/lanczos.h"

#include "base/own.h"

#include <math.h>

enum { LIMIT = 200, LIMIT_OWN = 2000, CALM = 12 };

/* The tridiagonal matrix of the iteration. */
typedef struct {
    double diagonal[LIMIT_OWN], off[LIMIT_OWN]; /* off[j] couples j and j + 1 */
    int size;
} tridiagonal;

/* True if all eigenvalues are below x: the pivots of t - x are all negative. */
static int all_below(const tridiagonal *t, double x)
{
    double pivot = t->diagonal[0] - x;
    for (int j = 1; j < t->size && pivot < 0; j++)
        pivot = t->diagonal[j] - x - t->off[j - 1] * t->off[j - 1] / pivot;
    return pivot < 0;
}

static double largest_of(const tridiagonal *t)
{
    double low = t->diagonal[0], high = low;
    for (int j = 0; j < t->size; j++) {
        const double spread = (j > 0 ? t->off[j - 1] : 0) + (j + 1 < t->size ? t->off[j] : 0);
        high = fmax(high, t->diagonal[j] + spread);
        low = fmax(low, t->diagonal[j]);
    }
    while (high - low > 1e-13 * high) {
        const double middle = 0.5 * (low + high);
        if (middle <= low || middle >= high) break;
        if (all_below(t, middle)) high = middle;
        else low = middle;
    }
    return high;
}

/* |last component| of the unit eigenvector of the eigenvalue x, by its recursion from the end. */
static double last_component(const tridiagonal *t, double x)
{
    double after = 0, here = 1, sum = 1;
    for (int j = t->size - 1; j > 0; j--) {
        const double before = -((t->diagonal[j] - x) * here +
                                (j + 1 < t->size ? t->off[j] : 0) * after) /
                              t->off[j - 1];
        after = here;
        here = before;
        sum += here * here;
        if (!(sum < 1e200)) return 0;
    }
    return 1 / sqrt(sum);
}

static double dot(const double *a, const double *b, size_t n)
{
    double sum = 0;
    for (size_t i = 0; i < n; i++) sum += a[i] * b[i];
    return sum;
}

/* One step: v (unit) and the one before to the next, w in place of the one before. Returns the norm
 * of the next. */
static double advance(const fracas_lanczos_problem *p, const double *v, double *w, double *scratch,
                      double before, double *diagonal)
{
    const size_t n = p->n;
    p->apply(p->context, v, scratch);
    for (size_t i = 0; i < n; i++) w[i] = scratch[i] - before * w[i];
    p->mass(p->context, v, scratch);
    *diagonal = dot(w, scratch, n);
    for (size_t i = 0; i < n; i++) w[i] -= *diagonal * v[i];
    p->mass(p->context, w, scratch);
    return sqrt(dot(w, scratch, n));
}

/* (bar.16) */
fracas_err fracas_lanczos(const fracas_lanczos_problem *problem, double *start, double *largest)
{
    const size_t n = problem->n;
    OWNED double *other = calloc(n, sizeof *other);
    OWNED double *scratch = malloc(n * sizeof *scratch);
    OWNED tridiagonal *t = calloc(1, sizeof *t);
    if (!other || !scratch || !t) return fracas_no_memory("the critical time step");
    double theta = 0, bound = INFINITY;
    problem->mass(problem->context, start, scratch);
    const double norm = sqrt(dot(start, scratch, n));
    for (size_t i = 0; i < n; i++) start[i] /= norm;
    double *v = start, *w = other, before = 0;
    const double tolerance = problem->tolerance > 0 ? problem->tolerance : 1e-4;
    const int limit = problem->tolerance > 0 ? LIMIT_OWN : LIMIT;
    for (int calm = 0;
         t->size < limit && (calm < CALM || (bound > 2e-3 * theta && !(problem->tolerance > 0)));) {
        const double next = advance(problem, v, w, scratch, before, &t->diagonal[t->size]);
        t->off[t->size++] = next;
        const double now = largest_of(t);
        bound = next * last_component(t, now);
        calm = fabs(now - theta) <= tolerance * now ? calm + 1 : 0;
        theta = now;
        if (!(next > 1e-12 * theta)) { /* an invariant subspace */
            bound = 0;
            break;
        }
        for (size_t i = 0; i < n; i++) w[i] /= next;
        double *swap = v;
        v = w;
        w = swap;
        before = next;
    }
    *largest = theta + (isfinite(bound) && !(problem->tolerance > 0) ? bound : 0);
    return FRACAS_OK;
}
