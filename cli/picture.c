/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "cli/cli.h"

#include "analysis/analysis.h"
#include "base/param.h"
#include "campaigns/campaign.h"

#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const fracas_option options[] = {
    {"point", "P", "which point (0): the first column of report/points.csv"},
    {"replica", "R", "which of its replicas (0)"},
    {"times", "LIST",
     "times, as 26us,28us, or how many, each after as many breaks, the last at the end (6; of a "
     "film "
     "24, half of them even)"},
    {"show", "WHAT", "cracks, fragments (these, and the cracks), or mesh (that, too) (fragments)"},
    {"view", "A,H",
     "from where, as 45,30: azimuth from x toward y, elevation above the plane of both, "
     "in degrees"},
    {"explode", "FACTOR",
     "fragments apart: moved by FACTOR times (their centroid - that of the surface) (0)"},
    {"film", NULL, "in the place of pictures a page that plays how the fragments move"},
    {"png", NULL, "pictures as PNG files, too, 1600 dots wide"},
    {"table", NULL, "first onset, break and crack through of all replicas of the point, as CSV"},
    {"output", "FOLDER", "where to; also -o FOLDER (STUDY/pictures)", 'o'},
    {0}};

static const double most_apart = 10;

/* "45,30"; false for anything else. */
static bool read_pair(const char *text, double *first, double *second)
{
    char *end;
    *first = strtod(text, &end);
    if (end == text || *end != ',') return false;
    text = end + 1;
    *second = strtod(text, &end);
    return end != text && !*end;
}

static fracas_err read_view(const fracas_arguments *arguments, fracas_picture_request *request,
                            fracas_view *view)
{
    const char *text = fracas_given(arguments, "view");
    if (text) {
        if (!read_pair(text, &view->azimuth, &view->elevation) || !(fabs(view->azimuth) <= 360) ||
            !(fabs(view->elevation) <= 90))
            return fracas_fail(
                FRACAS_USAGE,
                "picture: --view is `%s`; it must be two numbers, as 45,30: an azimuth from -360 "
                "to 360 and an elevation from -90 to 90, in degrees",
                text);
        request->view = view;
    }
    TRY(fracas_arguments_real(arguments, "explode", 1, &request->explode));
    if (request->explode <= most_apart) return FRACAS_OK;
    return fracas_fail(FRACAS_USAGE,
                       "picture: --explode is `%s`; it must be a number from 0 to %g, such as 0.15",
                       fracas_given(arguments, "explode"), most_apart);
}

static fracas_err picture(const fracas_arguments *arguments)
{
    static const char *const words[] = {[FRACAS_SHOW_CRACKS] = "cracks",
                                        [FRACAS_SHOW_FRAGMENTS] = "fragments",
                                        [FRACAS_SHOW_MESH] = "mesh"};
    int point = 0, replica = 0, show = FRACAS_SHOW_FRAGMENTS;
    OWNED double *time = NULL;
    fracas_view view;
    OWN(fracas_campaign) campaign = NULL;
    TRY(fracas_arguments_integer(arguments, "point", 0, INT_MAX, &point));
    TRY(fracas_arguments_integer(arguments, "replica", 0, INT_MAX, &replica));
    TRY(fracas_arguments_word(arguments, "show", words, FRACAS_COUNT(words), &show));
    fracas_picture_request request = {.point = (size_t)point,
                                      .replica = replica,
                                      .show = (fracas_surface_show)show,
                                      .table = fracas_given(arguments, "table") != NULL,
                                      .film = fracas_given(arguments, "film") != NULL,
                                      .dots = fracas_given(arguments, "png") != NULL,
                                      .folder = fracas_given(arguments, "output")};
    if (request.film && !request.dots &&
        (fracas_given(arguments, "show") || fracas_given(arguments, "view") ||
         fracas_given(arguments, "explode")))
        return fracas_fail(FRACAS_USAGE, "picture: a film has controls of its own: call --film "
                                         "without --show, --view and --explode");
    TRY(read_view(arguments, &request, &view));
    request.count = request.film ? FRACAS_FRAMES : FRACAS_MOMENTS;
    TRY(fracas_cli_times(arguments, &request.count, &time));
    if (time && request.film && !request.dots)
        TRY(fracas_cli_times_in_order(arguments, &request.count, time));
    request.time = time;
    TRY(fracas_cli_campaign_seen(arguments->operand, &campaign));
    if (campaign) request.campaign = &campaign->hash;
    return fracas_pictures_write(arguments->operand, &request, stdout);
}

const fracas_command fracas_command_picture = {
    .name = "picture",
    .operand = "STUDY",
    .doc = "Draws broken bodies of STUDY as SVG files, or as a film",
    .more =
        "\nSTUDY is a folder, or study.h5 alone.\n"
        "One file a time: the body as it was before any motion, its broken interfaces dark, "
        "cracked ones grey, each fragment\n"
        "filled, dust in orange; a bar with periodic ends is a circle. Then it prints when the "
        "realization first cracked, first broke,\n"
        "and (surfaces) first cracked through, from one edge to the other (annulus: inner and "
        "outer; plate: left and right, or bottom\n"
        "and top). The campaign must say `output: {interfaces: true}`.\n\n"
        "A surface that is not flat is shaded and seen from --view (45,35.264: the direction (1, "
        "1, 1)), z upward; what is hidden is left\n"
        "out. --explode 0.15 moves its fragments apart, so that the gaps and the inside show.\n\n"
        "A film moves each fragment as a rigid body, back from its place, velocity and spin at the "
        "end; `fracas replay --film`\n"
        "computes the motion again.\n",
    .options = options,
    .run = picture,
};
