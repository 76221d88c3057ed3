#include "cli/cli.h"

#include "base/json.h"
#include "base/param.h"
#include "campaigns/store/store.h"

enum { JSON };
static const fracas_option options[] = {[JSON] = {"json", NULL, "print the problems as JSON"}};

static void print_problem(void *json, const char *problem)
{
    if (json) fracas_json_text(json, NULL, problem);
    else puts(problem);
}

static fracas_err verify(const fracas_arguments *arguments)
{
    const char *study = arguments->operand;
    int64_t problems = 0;
    fracas_err code;
    TRY(fracas_cli_check_study(study));
    if (arguments->value[JSON]) {
        fracas_json json;
        fracas_json_begin(&json, stdout);
        fracas_json_object(&json, NULL);
        fracas_json_text(&json, "study", study);
        fracas_json_array(&json, "problems");
        code = fracas_study_verify(study, print_problem, &json, &problems);
        fracas_json_close_array(&json);
        fracas_json_boolean(&json, "sound", !code && !problems);
        fracas_json_close_object(&json);
        fracas_json_end(&json);
    } else {
        code = fracas_study_verify(study, print_problem, NULL, &problems);
        if (!code && !problems) printf("%s is sound\n", study);
    }
    if (code || !problems) return code;
    return fracas_fail(FRACAS_DAMAGED, "%s has %lld problem%s", study, (long long)problems, problems > 1 ? "s" : "");
}

const fracas_command fracas_command_verify = {
    .name = "verify", .operand = "STUDY", .doc = "Checks every byte of STUDY",
    .more = "\nSizes and checksums of all segments, the index against them row by row, and study.h5 record by record.\n"
            "Each problem is one line: what, where, and what to do. Status 5 if there is any.\n",
    .options = options, .noptions = FRACAS_COUNT(options), .run = verify,
};
