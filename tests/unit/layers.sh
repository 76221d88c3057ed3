#!/bin/sh
# tools/check-layers: the tree obeys, and each kind of forbidden include is found where it is planted.
set -eu

tools/check-layers

tree=$(mktemp -d)
trap 'rm -rf "$tree"' EXIT
rooms=$(for room in base engine sampler campaigns analysis cli tests; do [ ! -d "$room" ] || echo "$room"; done)
# shellcheck disable=SC2086 # a list of words
cp -R $rooms "$tree"

# Plants line $2 as line 3 of a new file $1, which must be the only violation found.
plant() {
    mkdir -p "$tree/$(dirname "$1")"
    printf '/* planted */\n\n%s\n' "$2" >"$tree/$1"
    if found=$(tools/check-layers "$tree"); then
        echo "not found: $2 in $1"
        exit 1
    fi
    rm "$tree/$1"
    if [ "$(echo "$found" | grep -c "^$1:3: ")" != 1 ] || [ "$(echo "$found" | wc -l)" != 2 ]; then
        echo "planted: $2 in $1; found: $found"
        exit 1
    fi
}

# Who may include whom.
plant base/planted.c '#include "engine/spec.h"'
plant engine/planted.c '#include "sampler/api/sampler.h"'
plant engine/mesh/planted.h '#  include "campaigns/points.h"'
plant sampler/planted.c '#include "engine/spec.h"'
plant campaigns/planted.c '#include "campaigns/store/study.h"'
plant campaigns/file/planted.c '#include "campaigns/store/study.h"'
plant campaigns/plan/planted.c '#include "campaigns/scheduler/run.h"'
plant campaigns/store/planted.c '#include "engine/engine.h"'
plant campaigns/store/planted.c '#include "campaigns/campaign.h"'
plant campaigns/store/file/planted.c '#include "campaigns/store/index/index.h"'
plant campaigns/store/index/planted.c '#include "campaigns/store/study/segments.h"'
plant campaigns/store/study/planted.c '#include <sqlite3.h>'
plant campaigns/scheduler/planted.c '#include "analysis/analysis.h"'
plant analysis/planted.c '#include "campaigns/campaign.h"'
plant analysis/planted.c '#include "engine/engine.h"'
plant analysis/report/planted.c '#include <librsvg/rsvg.h>'
plant analysis/report/planted.c '#include <openssl/evp.h>'
plant analysis/planted.c '#include <cairo-pdf.h>'
plant campaigns/planted.c '#include "cli/cli.h"'

# Which room alone knows a library.
plant analysis/planted.c '#include <mpi.h>'
plant campaigns/file/planted.h '#include <mpi.h>'
plant analysis/planted.c '#include <hdf5.h>'
plant tests/unit/planted.c '#include <hdf5.h>'
plant cli/planted.c '#include <sqlite3.h>'
plant campaigns/planted.c '#include <yaml.h>'
plant engine/planted.c '#include <gsl/gsl_randist.h>'
plant engine/planted.c '#include <Random123/philox.h>'
plant campaigns/store/planted.c '#include <xxhash.h>'
plant campaigns/file/planted.c '#include <udunits2.h>'

# Ways around the rule.
plant engine/planted.c '#include "../sampler/api/sampler.h"'
plant engine/planted.c '#include "base/../sampler/api/sampler.h"'
plant engine/planted.c '#include <base/../sampler/api/sampler.h>'
plant engine/planted.c '#include "spec.h"'
plant engine/planted.c '#include <sampler/api/sampler.h>'
plant engine/planted.c '#include "mpi.h"'
plant engine/planted.c '#include SAMPLER_HEADER'

# Two headers with the guard of one.
plant sampler/zplanted.h '#ifndef FRACAS_SAMPLER_STRENGTH_H'

# Folders in a circle: two that include each other, and three, each of which one include closes. Two files of one folder may.
circle() {
    if found=$(tools/check-layers "$tree"); then
        echo "not found: a circle of $1"
        exit 1
    fi
    for step in "circle of folders: $1" "$2"; do
        echo "$found" | grep -qF "$step" || { echo "no \"$step\" in: $found"; exit 1; }
    done
}
mkdir -p "$tree/base/one" "$tree/base/two" "$tree/base/three"
printf '#include "base/two/b.h"\n' >"$tree/base/one/a.h"
printf '#include "base/two/c.h"\n' >"$tree/base/two/b.h"
printf '#include "base/two/b.h"\n' >"$tree/base/two/c.h"
tools/check-layers "$tree"
printf '\n#include "base/one/a.h"\n' >"$tree/base/two/d.c"
circle "base/one base/two" "base/two -> base/one (base/two/d.c:2)"
printf '#include "base/three/e.h"\n' >"$tree/base/two/d.c"
printf '#include "base/one/a.h"\n' >"$tree/base/three/e.h"
circle "base/one base/three base/two" "base/three -> base/one (base/three/e.h:1)"
rm -r "$tree/base/one" "$tree/base/two" "$tree/base/three"

# A tree without sources is no success.
mkdir "$tree/empty"
if tools/check-layers "$tree/empty"; then exit 1; fi
