/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "analysis/report/page.h"

#include "base/file.h"
#include "base/own.h"

#include <string.h>

/* The chunk tEXt `Software: fracas` with its checksum, behind the signature and the chunk IHDR. */
static const char png_mark[] = "\0\0\0\x0ftEXtSoftware\0fracas\xf0\x42\x9f\x0c";
enum { PNG_MARK = sizeof png_mark - 1, PNG_MARK_AT = 33 };

bool fracas_convert_made_png(const char *path)
{
    char start[PNG_MARK_AT + PNG_MARK];
    OWN(FILE) in = fracas_file_stream(fracas_file_open(path), "rb");
    return in && fread(start, 1, sizeof start, in) == sizeof start &&
           memcmp(start + PNG_MARK_AT, png_mark, PNG_MARK) == 0;
}

#ifdef FRACAS_PDF

#include "analysis/data/output.h"
#include "base/param.h"

#include <cairo-pdf.h>
#include <librsvg/rsvg.h>

#include <dlfcn.h>
#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

const bool fracas_convert_possible = true;

static const double points_a_pixel = 72.0 / 96, dots_a_pixel = 2;

/* ---- the child ---- */

/* librsvg brings some fifty libraries, 9 MB and 50 ms at each start of the program, which ranks and
 * workers need not pay: it is loaded here. */
/* clang-format off */
#define FUNCTIONS(X) \
    X(rsvg_handle_new_from_file) \
    X(rsvg_handle_get_intrinsic_size_in_pixels) \
    X(rsvg_handle_render_document) \
    X(cairo_pdf_surface_create_for_stream) \
    X(cairo_pdf_surface_set_metadata) \
    X(cairo_image_surface_create) \
    X(cairo_surface_write_to_png_stream) \
    X(cairo_set_source_rgb) \
    X(cairo_paint) \
    X(cairo_create) \
    X(cairo_destroy) \
    X(cairo_surface_finish) \
    X(cairo_surface_status) \
    X(cairo_surface_destroy) \
    X(cairo_status_to_string) \
    X(g_object_unref)
/* clang-format on */

typedef struct {
#define MEMBER(name) __typeof__(&name) name;
    FUNCTIONS(MEMBER)
} library;

static fracas_err load(library *of)
{
    void *handle = dlopen("librsvg-2.so.2", RTLD_NOW | RTLD_LOCAL); /* cairo, too */
    if (!handle)
        return fracas_fail(
            FRACAS_ENVIRONMENT,
            "no PDFs and PNGs without the library they are drawn with, Debian's librsvg2-2: %s",
            dlerror());
    void *found;
#define LOAD(name)                                                                       \
    found = dlsym(handle, #name);                                                        \
    if (!found)                                                                          \
        return fracas_fail(                                                              \
            FRACAS_ENVIRONMENT,                                                          \
            "no PDFs and PNGs: librsvg-2.so.2 is not the one fracas was built with: %s", \
            dlerror());                                                                  \
    memcpy(&of->name, &found, sizeof found); /* no cast: ISO C */
    FUNCTIONS(LOAD)
    return FRACAS_OK;
}

static cairo_status_t put(void *out, const unsigned char *bytes, unsigned size)
{
    return fwrite(bytes, 1, size, out) == size ? CAIRO_STATUS_SUCCESS : CAIRO_STATUS_WRITE_ERROR;
}

/* cairo hands over pieces of chunks, none across the end of one. */
static cairo_status_t put_png(void *out, const unsigned char *bytes, unsigned size)
{
    if (ftell(out) == PNG_MARK_AT && fwrite(png_mark, 1, PNG_MARK, out) != PNG_MARK)
        return CAIRO_STATUS_WRITE_ERROR;
    return put(out, bytes, size);
}

static cairo_surface_t *begin_pdf(const library *lib, double width, double height, FILE *out)
{
    cairo_surface_t *surface = lib->cairo_pdf_surface_create_for_stream(put, out, width, height);
    lib->cairo_pdf_surface_set_metadata(surface, CAIRO_PDF_METADATA_CREATE_DATE,
                                        ""); /* equal studies, equal files */
    return surface;
}

static cairo_surface_t *begin_png(const library *lib, double width, double height, FILE *out)
{
    (void)out;
    return lib->cairo_image_surface_create(CAIRO_FORMAT_RGB24, (int)ceil(width), (int)ceil(height));
}

static cairo_status_t end_pdf(const library *lib, cairo_surface_t *surface, FILE *out)
{
    (void)out;
    lib->cairo_surface_finish(surface);
    return lib->cairo_surface_status(surface);
}

static cairo_status_t end_png(const library *lib, cairo_surface_t *surface, FILE *out)
{
    return lib->cairo_surface_write_to_png_stream(surface, put_png, out);
}

typedef struct {
    const char *ending;
    double scale; /* units of the surface a pixel of the drawing */
    cairo_surface_t *(*begin)(const library *lib, double width, double height, FILE *out);
    cairo_status_t (*end)(const library *lib, cairo_surface_t *surface, FILE *out);
} format;

static const format formats[] = {
    [FRACAS_DRAWING_PDF] = {"pdf", points_a_pixel, begin_pdf, end_pdf},
    [FRACAS_DRAWING_PNG] = {"png", dots_a_pixel, begin_png, end_png},
};

static fracas_err draw(const library *lib, const format *as, RsvgHandle *drawing, const char *to,
                       FILE *out)
{
    double width, height;
    if (!lib->rsvg_handle_get_intrinsic_size_in_pixels(drawing, &width, &height))
        return fracas_fail(FRACAS_BUG, "the drawing for %s has no size", to);
    width *= as->scale;
    height *= as->scale;
    cairo_surface_t *surface = as->begin(lib, width, height, out);
    cairo_t *cairo = lib->cairo_create(surface);
    GError *error = NULL;
    const RsvgRectangle page = {0, 0, width, height};
    fracas_err err = FRACAS_OK;
    lib->cairo_set_source_rgb(cairo, 1, 1, 1);
    if (as == &formats[FRACAS_DRAWING_PNG]) lib->cairo_paint(cairo);
    if (!lib->rsvg_handle_render_document(drawing, cairo, &page, &error))
        err = fracas_fail(FRACAS_ENVIRONMENT, "cannot draw %s: %s", to, error->message);
    lib->cairo_destroy(cairo);
    const cairo_status_t status = as->end(lib, surface, out);
    lib->cairo_surface_destroy(surface);
    if (!err && status)
        err = fracas_fail(FRACAS_ENVIRONMENT, "cannot write %s: %s", to,
                          lib->cairo_status_to_string(status));
    return err;
}

static fracas_err convert(const library *lib, const format *as, const char *folder,
                          const char *name)
{
    OWNED char *from = NULL;
    char file[FRACAS_DRAWING + 4];
    fracas_output_file output;
    TRY(fracas_path(&from, "%s/%s.svg", folder, name));
    FRACAS_PRINT(file, "%s.%s", name, as->ending);
    GError *error = NULL;
    RsvgHandle *drawing = lib->rsvg_handle_new_from_file(from, &error);
    if (!drawing)
        return fracas_fail(FRACAS_ENVIRONMENT, "cannot read %s to make a %s of it: %s", from,
                           as->ending, error->message);
    fracas_err err = fracas_output_open(folder, file, &output);
    if (!err) err = fracas_output_close(&output, draw(lib, as, drawing, output.path, output.file));
    lib->g_object_unref(drawing);
    return err;
}

/* A failure is reported through the pipe. */
static _Noreturn void child(const format *as, const char *folder, char (*name)[FRACAS_DRAWING],
                            size_t count, int pipe_end)
{
    library lib = {0};
    fracas_err err = load(&lib);
    for (size_t i = 0; i < count && !err; i++) err = convert(&lib, as, folder, name[i]);
    const char *message = err ? fracas_message() : "";
    ssize_t n;
    do n = write(pipe_end, message, strlen(message));
    while (n < 0 && errno == EINTR);
    if (n < 0) err = FRACAS_ENVIRONMENT;
    _exit(err); /* not through the exit handlers of the parent */
}

/* ---- the parent ---- */

static void listen_to(int pipe_end, char *message, size_t size)
{
    size_t used = 0;
    for (;;) {
        const ssize_t got = read(pipe_end, message + used, size - 1 - used);
        if (got > 0) used += (size_t)got;
        else if (got == 0 || errno != EINTR) break;
    }
    message[used] = '\0';
}

static fracas_err verdict(int status, const char *message, const char *folder)
{
    if (WIFEXITED(status) && WEXITSTATUS(status) == FRACAS_OK) return FRACAS_OK;
    if (*message) return fracas_fail(FRACAS_ENVIRONMENT, "%s", message);
    return fracas_fail(FRACAS_ENVIRONMENT,
                       "the process that makes the PDFs or PNGs of %s was lost (%s %d); is memory "
                       "short? The same command makes them again",
                       folder, WIFSIGNALED(status) ? "signal" : "status",
                       WIFSIGNALED(status) ? WTERMSIG(status) : WEXITSTATUS(status));
}

fracas_err fracas_convert_check(void)
{
    library found;
    return load(&found);
}

fracas_err fracas_convert(const char *folder, char (*name)[FRACAS_DRAWING], size_t count,
                          fracas_drawing_format as)
{
    int ends[2], status = 0;
    char message[1024];
    if (count == 0) return FRACAS_OK;
    if (pipe(ends))
        return fracas_fail_system(errno,
                                  "cannot make a pipe to the process that converts drawings");
    fflush(NULL);
    const pid_t pid = fork();
    if (pid < 0) {
        const int why = errno;
        close(ends[0]);
        close(ends[1]);
        return fracas_fail_system(why, "cannot start the process that converts drawings");
    }
    if (pid == 0) child(&formats[as], folder, name, count, ends[1]);
    close(ends[1]);
    listen_to(ends[0], message, sizeof message);
    close(ends[0]);
    while (waitpid(pid, &status, 0) < 0)
        if (errno != EINTR)
            return fracas_fail_system(errno, "cannot wait for the process that converts drawings");
    return verdict(status, message, folder);
}

#else

const bool fracas_convert_possible = false;

fracas_err fracas_convert_check(void)
{
    return FRACAS_OK;
}

fracas_err fracas_convert(const char *folder, char (*name)[FRACAS_DRAWING], size_t count,
                          fracas_drawing_format as)
{
    (void)folder;
    (void)name;
    (void)count;
    (void)as;
    return FRACAS_OK;
}

#endif
