/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "analysis/draw/html.h"

#include "analysis/data/output.h"
#include "analysis/data/text.h"
#include "analysis/draw/chart.h"
#include "analysis/export/sha256.h"

/* A page loads nothing and runs its own script only, whatever its texts may hold. Drawings have
 * attributes of style, which no hash allows. */
static void put_policy(const char *script, FILE *out)
{
    fracas_markup(out,
                  "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; "
                  "img-src data:; style-src 'unsafe-inline'; script-src 'sha256-%s'; "
                  "base-uri 'none'; form-action 'none'\"/>\n",
                  script);
}

fracas_err fracas_html_begin(const char *title, const char *lead, const char *script, int refresh,
                             FILE *out)
{
    char digest[FRACAS_SHA256_BASE64];
    TRY(fracas_sha256_of_text(script, digest));
    fputs("<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\"/>\n", out);
    put_policy(digest, out);
    if (refresh) fprintf(out, "<meta http-equiv=\"refresh\" content=\"%d\"/>\n", refresh);
    fracas_markup(out,
                  "<meta name=\"viewport\" content=\"width=device-width,initial-scale=1\"/>\n"
                  "<link rel=\"icon\" href=\"data:,\"/>\n<title>"
                  "%s",
                  title);
    fprintf(out, " \u00b7 fracas</title>\n<style>\n%s%s%s", fracas_chart_style,
            fracas_surface_style, fracas_page_style);
    fracas_markup(
        out,
        "</style>\n</head>\n<body>\n<header>\n<h1>%s</h1>\n<p class=\"lead\">%s</p>\n</header>\n",
        title, lead);
    return FRACAS_OK;
}

void fracas_html_end(const char *script, FILE *out)
{
    fprintf(out, "<script>%s</script>\n</body>\n</html>\n", script);
}

fracas_err fracas_html_alone(const char *folder, const char *file, const char *title,
                             const char *lead, const char *body, const char *script)
{
    fracas_output_file output;
    TRY(fracas_output_open(folder, file, &output));
    const fracas_err err = fracas_html_begin(title, lead, script, 0, output.file);
    fprintf(output.file, "<main>\n%s</main>\n", body);
    fracas_html_end(script, output.file);
    return fracas_output_close(&output, err);
}
