/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Parameter tables: the one description of every value of a campaign file.
 *
 * A section of the file fills one C struct. A table says, for each key, its type, unit, range,
 * default and where in the struct it goes; parsing, validation, the resolved file, HDF5 columns and
 * the reference page (`fracas reference`) are all driven by it. A section may have a selector: a
 * key whose value names a kind (a law, a distribution, a stop rule ...), each with a table of its
 * own. */
#ifndef FRACAS_BASE_PARAM_H
#define FRACAS_BASE_PARAM_H

#include "base/err.h"

#include <math.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef enum {
    FRACAS_REAL,    /* double, may carry a unit */
    FRACAS_INTEGER, /* int64_t */
    FRACAS_BOOLEAN, /* bool */
    FRACAS_CHOICE,  /* const fracas_kind *, one of `choices`, no parameters; default: the first */
    FRACAS_ATTACHMENT, /* const fracas_attachment *, a file named by its path; NULL: none given */
    FRACAS_NUMBERS     /* const fracas_numbers *, in sections for runs alone; NULL: none given */
} fracas_param_type;

/* A value of a selector. Objects with functions (a law, a distribution) have it as first member. */
typedef struct fracas_kind fracas_kind;

/* A file named in a campaign file, read whole along with it: the rooms that understand its content
 * read no files. */
typedef struct {
    const char *path; /* as named */
    const char *text; /* content, and a NUL after it */
    size_t size;      /* bytes, without the final NUL */
    char digest[33];  /* hexadecimal XXH3 of the content: its part in a point's identity */
} fracas_attachment;

/* A list of whole numbers. */
typedef struct {
    size_t n;
    const int64_t *value;
} fracas_numbers;

/* A required value has no default. */
#define FRACAS_REQUIRED NAN

typedef struct {
    const char *name; /* key in its section */
    fracas_param_type type;
    const char *unit;                  /* SI unit as UDUNITS-2 reads it; "1" for a pure number */
    const char *doc;                   /* one sentence, no full stop */
    double fallback;                   /* default in SI, FRACAS_REQUIRED if there is none */
    double minimum;                    /* allowed range, both ends included unless minimum_open */
    double maximum;                    /* INFINITY: no upper limit */
    bool minimum_open;                 /* value must be > minimum */
    size_t offset;                     /* place of the value in the section's struct */
    const fracas_kind *const *choices; /* for FRACAS_CHOICE */
    size_t nchoices;
    unsigned only; /* models with this parameter: those of one of these groups, bits; 0: all */
    bool optional; /* no default: without it NaN or NULL; not for FRACAS_INTEGER, FRACAS_BOOLEAN */
    const char *keys_of; /* FRACAS_CHOICE among keys of this section: names of its `rename`, too */
} fracas_param;

struct fracas_kind {
    const char *name;
    const char *doc;
    const fracas_param *params;
    size_t nparams;
    /* Kinds of other sections that this one can be combined with. A section of which at least one
     * kind is named here takes those only, and the first of them by default; of any other section
     * it takes every kind. Only `model` restricts. */
    const fracas_kind *const *goes_with;
    size_t ngoes_with;
    /* The other way round: models that this kind can be combined with are those of one of these
     * groups, bits; 0: it is for the models to name it. */
    unsigned only;
    unsigned groups;    /* those that a model is in, bits */
    const void *traits; /* a struct of the section's own: answers to all who would ask which kind */
};

enum { FRACAS_RENAMED = 64 }; /* characters of a name that an attachment gives to a key, with NUL */

typedef struct fracas_section fracas_section;
struct fracas_section {
    const char *name; /* key of the section at the top of the file */
    const char *doc;
    const char *selector;            /* key that names the kind; NULL: the section has no kinds */
    const fracas_kind *const *kinds; /* registry; the first is the default */
    size_t nkinds;
    /* The section is the item after `follows` of a list: `follows: [{...}, {...}]`. It is no key of
     * the file's top, and without its selector not there: its kind is NULL. NULL: no list. */
    const fracas_section *follows;
    size_t kind_offset;         /* place of the `const fracas_kind *` in the section's struct */
    const fracas_param *params; /* keys common to all kinds */
    size_t nparams;
    size_t offset; /* place of the section's struct in its owner (see the registry) */
    bool hashed;   /* part of a point's identity (output options are not) */
    bool run;      /* for runs alone: in no hash and no resolved file */
    fracas_err (*check)(const void *section); /* checks values against each other; NULL: none */
    /* An attachment may give keys further names: changes such a name, *key, into its key; leaves
     * any other text. FRACAS_USAGE for a name without a key. NULL: no attachment of the section
     * does. */
    fracas_err (*rename)(const fracas_attachment *of, const char **key);
    /* Name number i, from 0, of those: false after the last. */
    bool (*renames)(const fracas_attachment *of, size_t i, char name[FRACAS_RENAMED]);
    const char *renamed; /* one of these keys: all take its values; NULL without `rename` */
};

#define FRACAS_COUNT(array) (sizeof(array) / sizeof *(array))

/* Braces of an initializer, in a macro. */
#define FRACAS_BRACES(...) \
    {                      \
        __VA_ARGS__        \
    }

/* Initializers of members that name an array and its length. */
#define FRACAS_PARAMS(array) .params = array, .nparams = FRACAS_COUNT(array)
#define FRACAS_KINDS(array) .kinds = array, .nkinds = FRACAS_COUNT(array)
#define FRACAS_GOES_WITH(array) .goes_with = array, .ngoes_with = FRACAS_COUNT(array)
/* Initializers of a FRACAS_CHOICE among the kinds of an array. */
#define FRACAS_ONE_OF(key, array, place, text)                         \
    .name = key, .type = FRACAS_CHOICE, .unit = "1", .choices = array, \
    .nchoices = FRACAS_COUNT(array), .offset = place, .doc = text

/* True for choices and attachments, whose values are texts. */
static inline bool fracas_param_is_text(const fracas_param *param)
{
    return param->type == FRACAS_CHOICE || param->type == FRACAS_ATTACHMENT;
}

/* True for types whose value is a pointer into the campaign's memory. */
static inline bool fracas_param_is_object(const fracas_param *param)
{
    return param->type == FRACAS_ATTACHMENT || param->type == FRACAS_NUMBERS;
}

/* The parameter's value in the section's struct at `section`, as a double: for a choice its index
 * (NaN for none of them); for an object NaN. */
double fracas_param_get(const fracas_param *param, const void *section);

/* Stores the value for "not given": NaN, or NULL. */
void fracas_param_clear(const fracas_param *param, void *section);

/* False for an optional parameter without a value. */
bool fracas_param_is_given(const fracas_param *param, const void *section);

/* Stores `value` (SI, already validated; for a choice its index) in the section's struct; does
 * nothing for an object. */
void fracas_param_set(const fracas_param *param, void *section, double value);

/* The same of an object; NULL for none. */
const void *fracas_param_object(const fracas_param *param, const void *section);
void fracas_param_place(const fracas_param *param, void *section, const void *object);

/* Text for the value of a choice or attachment in a point: the name, the digest; "" where there is
 * none, and for any other type. */
const char *fracas_param_text(const fracas_param *param, const void *section);

/* True if points of this model (NULL: none is chosen) have the parameter. */
bool fracas_param_is_of(const fracas_param *param, const fracas_kind *model);

/* FRACAS_USAGE unless exactly one of two keys of a section is given: not 0, its default, so that
 * a sweep can take it back. `takes` is who takes them, with its verb; `example` gives the first. */
FRACAS_MUST_USE fracas_err fracas_param_check_either(const char *takes, const char *const key[2],
                                                     const double value[2], const char *example);

/* Kind number i, from 0, of `section` among those `kind` names in goes_with, in that order, and
 * then those that name it in `only`, in the order of the section; NULL after the last. */
const fracas_kind *fracas_kind_partner(const fracas_kind *kind, const fracas_section *section,
                                       size_t i);

#endif
