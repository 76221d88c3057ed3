/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Meshes in study.h5: what is merged comes back, whatever else is damaged, and what pictures are
 * refused of it. */
#include "tests/support/body.h"
#include "tests/support/study_fixture.h"

#include "analysis/analysis.h"
#include "analysis/draw/surface_picture.h"
#include "campaigns/store/study.h"

enum {
    SURFACE = 1,
    EACH = 5
}; /* the one of the three points that is a surface; replicas of each */

static const grid_shape shape = {.nx = 4, .ny = 3, .middles = true};

static fracas_err get_mesh(const void *context, size_t point, fracas_stored_mesh *mesh)
{
    if (point == SURFACE) grid_make(context, mesh);
    return FRACAS_OK;
}

static const fracas_mesh_source source = {get_mesh, &shape};

/* Elements of a surface with so many interfaces: of the octant, or of the grid. */
static size_t elements_of(size_t interfaces)
{
    return interfaces == 18 ? 16 : 2 * (size_t)(shape.nx * shape.ny);
}

/* Replica 2 FAILED, 3 has places that are no numbers, the others have `interfaces` of them:
 * interface i of replica r cracks at r + i [us] and breaks 0.5 us later. Elements of a surface
 * become fragments. */
static void make_record(size_t point, int64_t replica, size_t interfaces, fracas_record *record)
{
    fracas_record_init(record);
    if (point == SURFACE && replica == 2) return;
    record->outcome = FRACAS_INTACT;
    record->nfragment = point == SURFACE ? elements_of(interfaces) : 0;
    record->fragments = (int64_t)record->nfragment;
    record->fragment = calloc(record->nfragment + 1, sizeof *record->fragment);
    for (size_t f = 0; f < record->nfragment; f++)
        record->fragment[f] = (fracas_fragment){
            .mass = 1, .size = 1, .elements = 1, .dust = 1, .position = {replica == 3 ? NAN : 0}};
    record->end_time = 1e-4;
    record->onset_time = 1e-6 * (double)replica;
    record->dissipated = record->residual = 0;
    record->ninterface = interfaces;
    record->interface = calloc(interfaces + 1, sizeof *record->interface);
    for (size_t i = 0; i < interfaces; i++) {
        const double onset = 1e-6 * (double)(replica + (int64_t)i);
        record->interface[i] = (fracas_interface_row){
            .strength = 1, .damage = 1, .onset_time = onset, .break_time = onset + 5e-7};
    }
}

/* All replicas of every point, in segments of `size`, the last ones first. */
static void commit(size_t size, size_t interfaces)
{
    fracas_file_header header = sample_header();
    for (size_t end = SAMPLE_POINTS * EACH, number = 0; end > 0; number++) {
        const size_t begin = end > size ? end - size : 0;
        fracas_writer *writer;
        fracas_file_seal seal;
        fracas_segment_row row[SAMPLE_POINTS * EACH];
        char name[32], path[64];
        snprintf(name, sizeof name, "m%zu.h5", number);
        snprintf(path, sizeof path, "segments/%s", name);
        OK(fracas_writer_create(sample_path(study, path), &header, &table, &writer));
        for (size_t i = begin; i < end; i++) {
            FRACAS_CLEARED(fracas_record) record;
            const size_t point = i / EACH;
            const int64_t replica = (int64_t)(i % EACH);
            make_record(point, replica, point == SURFACE ? interfaces : 7, &record);
            row[i - begin] = (fracas_segment_row){table.point[point].hash, replica,
                                                  (int64_t)(i - begin), fracas_summary_of(&record)};
            OK(fracas_writer_append(writer, point, replica, &record));
        }
        OK(fracas_writer_finish(writer, false, &seal));
        OK(fracas_index_commit(index_, name, &seal, row, end - begin, "{}"));
        end = begin;
    }
}

static void merge_with(const fracas_mesh_source *meshes)
{
    fracas_file_header header = sample_header();
    OK(fracas_study_merge(study, index_, &header, &table, meshes, NULL));
}

/* As set_up, with fewer replicas. */
static int set_up_surface(void **state)
{
    study = sample_folder();
    table = sample_table(point_row, EACH);
    begin_study();
    return 0;
}

static size_t interfaces_of(const grid_shape *of)
{
    FRACAS_CLEARED(fracas_stored_mesh) mesh;
    grid_make(of, &mesh);
    return mesh.ninterfaces;
}

static void meshes_come_back_bit_by_bit(void **state)
{
    fracas_reader *reader;
    fracas_stored_mesh wanted, found;
    size_t interfaces;
    grid_make(&shape, &wanted);
    commit(4, wanted.ninterfaces);
    merge_with(&source);
    verify_finds(0, "");
    OK(fracas_reader_open(sample_path(study, "study.h5"), &reader));
    for (size_t p = 0; p < SAMPLE_POINTS; p++) {
        OK(fracas_reader_mesh(reader, p, &found));
        OK(fracas_reader_mesh_interfaces(reader, p, &interfaces));
        assert_int_equal(interfaces, p == SURFACE ? wanted.ninterfaces : 0);
        if (p == SURFACE) assert_true(fracas_stored_mesh_same(&wanted, &found));
        else
            assert_true(found.nnodes == 0 && found.nelements == 0 && found.ninterfaces == 0 &&
                        found.nborders == 0);
        fracas_stored_mesh_clear(&found);
    }
    FAILS(fracas_reader_mesh(reader, SAMPLE_POINTS, &found), FRACAS_BUG, "point 3");
    OK(fracas_reader_check_meshes(reader, &source));
    const grid_shape other = {.nx = 4, .ny = 3};
    const fracas_mesh_source others = {get_mesh, &other};
    FAILS(fracas_reader_check_meshes(reader, &others), FRACAS_DAMAGED,
          "mesh of point 1 is not that of the campaign");
    fracas_reader_close(reader);
    fracas_stored_mesh_clear(&wanted);
}

static void order_of_segments_changes_no_mesh(void **state)
{
    commit(4, interfaces_of(&shape));
    merge_with(&source);
    keep_first();
    begin_study_again();
    commit(3, interfaces_of(&shape));
    merge_with(&source);
    assert_true(study_is_the_first());
}

static fracas_err no_mesh(const void *context, size_t point, fracas_stored_mesh *mesh)
{
    return FRACAS_OK;
}

/* Bars and rings: the bytes of a study that has never heard of meshes. */
static void without_surfaces_nothing_is_added(void **state)
{
    static const fracas_mesh_source none = {no_mesh, NULL};
    commit(4, 9);
    merge_with(NULL);
    keep_first();
    merge_with(&none);
    assert_true(study_is_the_first());
    verify_finds(0, "");
}

static fracas_err refuse(const void *context, size_t point, fracas_stored_mesh *mesh)
{
    return point == 2 ? fracas_fail(FRACAS_USAGE, "no such mesh") : FRACAS_OK;
}

static fracas_err faulty(const void *context, size_t point, fracas_stored_mesh *mesh)
{
    TRY(get_mesh(context, point, mesh));
    if (point == SURFACE) mesh->interface[3].node[1] = mesh->interface[3].node[0];
    return FRACAS_OK;
}

/* What fails leaves no study.h5 and no temporary file; what does not fit is found. */
static void faulty_meshes_are_refused(void **state)
{
    const fracas_mesh_source refusing = {refuse, NULL}, broken = {faulty, &shape};
    fracas_file_header header = sample_header();
    commit(4, interfaces_of(&shape) - 1);
    FAILS(fracas_study_merge(study, index_, &header, &table, &refusing, NULL), FRACAS_USAGE,
          "no such mesh");
    FAILS(fracas_study_merge(study, index_, &header, &table, &broken, NULL), FRACAS_BUG,
          "no edge of its elements");
    assert_int_equal(sample_files(study, "study.h5"), 0);
    merge_with(&source);
    verify_finds(EACH - 1,
                 "has 28 interfaces, the mesh of its point 29"); /* all but the one that FAILED */
}

/* Every kind of number that does not belong there. */
static void faults_of_meshes(void **state)
{
    static const char *const wanted[] = {
        "no position",          "node that does not exist", "node that does not exist",
        "interface is no edge", "interface is no edge",     "border is no edge",
        "border is no edge"};
    for (int k = 0; k < 7; k++) {
        fracas_stored_mesh mesh;
        grid_make(&shape, &mesh);
        assert_null(fracas_stored_mesh_fault(&mesh));
        switch (k) {
        case 0: mesh.node[5].position[2] = NAN; break;
        case 1: mesh.element[2].node[1] = (int64_t)mesh.nnodes; break;
        case 2: mesh.element[2].node[0] = -1; break;
        case 3: mesh.interface[1].element[1] = -1; break;
        case 4: mesh.interface[1].node[2] = 0; break;
        case 5: mesh.border[1].element = (int64_t)mesh.nelements; break;
        default: mesh.border[1].node[0] = mesh.border[1].node[1]; break;
        }
        const char *fault = fracas_stored_mesh_fault(&mesh);
        assert_non_null(fault);
        assert_has(fault, wanted[k]);
        fracas_stored_mesh_clear(&mesh);
    }
}

/* ---- pictures of a study ---- */

static void refused(const char *folder, fracas_picture_request request, const char *text)
{
    FILE *out = fopen("/dev/null", "w");
    request.folder = sample_path(folder, "drawn");
    FAILS(fracas_pictures_write(folder, &request, out), FRACAS_USAGE, text);
    assert_int_equal(sample_files(folder, "drawn"), 0);
    fclose(out);
}

static void pictures_of_what_is_not_there(void **state)
{
    static const double late = 2e-4, early = -1e-9;
    commit(4, interfaces_of(&shape));
    merge_with(&source);
    refused(study, (fracas_picture_request){.point = 3, .count = 6}, "there is no point 3");
    refused(study, (fracas_picture_request){.point = 1, .replica = EACH, .count = 6},
            "there is no replica 5: point 1 has 5");
    refused(study, (fracas_picture_request){.point = 1, .replica = -1, .count = 6},
            "there is no replica -1");
    refused(study, (fracas_picture_request){.point = 1, .replica = 2, .count = 6},
            "replica 2 of point 1 ended FAILED");
    refused(study, (fracas_picture_request){.point = 1, .replica = 3, .count = 2, .film = true},
            "places or velocities of fragments are no numbers");
    refused(study, (fracas_picture_request){.point = 1, .count = 1, .time = &late},
            "time 200.0 us is outside of the realization, which goes from 0 to 100.0 us");
    refused(study, (fracas_picture_request){.point = 1, .count = 1, .time = &early},
            "outside of the realization");
    fracas_reader *reader;
    fracas_file_header header = sample_header();
    fracas_writer *writer;
    fracas_file_seal seal;
    header.interfaces = false;
    OK(fracas_writer_create(sample_path(study, "study.h5"), &header, &table, &writer));
    const fracas_stored_mesh none = {0};
    FAILS(fracas_writer_mesh(writer, &none), FRACAS_BUG, "keeps no interfaces");
    OK(fracas_writer_finish(writer, false, &seal));
    OK(fracas_reader_open(sample_path(study, "study.h5"), &reader));
    fracas_reader_close(reader);
    refused(study, (fracas_picture_request){.point = 1, .count = 6}, "keeps no interfaces");
}

/* Two pictures and the table; replica 1 of point 1 cracks first at 1 us and breaks first at 1.5 us.
 */
static void pictures_and_first_times(void **state)
{
    static const double time[] = {2e-6, 9e-5};
    OWNED char *folder = strdup(sample_path(study, "drawn"));
    commit(4, interfaces_of(&shape));
    merge_with(&source);
    FILE *out = text_begin();
    const fracas_picture_request request = {.point = 1,
                                            .replica = 1,
                                            .count = 2,
                                            .time = time,
                                            .show = FRACAS_SHOW_FRAGMENTS,
                                            .table = true,
                                            .folder = folder};
    OK(fracas_pictures_write(study, &request, out));
    OWNED char *said = text_end(out);
    assert_has(said, "drawn/surface-point-1-replica-1-1.svg: 2.000 us\n");
    assert_has(said, "drawn/surface-point-1-replica-1-2.svg: 90.00 us\n");
    assert_has(said, "first onset: 1.000 us\nfirst break: 1.500 us\nfirst crack through: ");
    assert_int_equal(sample_files(folder, ".svg"), 2);
    OWNED char *csv = whole_file(sample_path(folder, "times-point-1.csv"));
    assert_has(csv, "replica,outcome,first_onset,first_break,first_through,");
    assert_has(csv, "\n1,INTACT,1e-06,1.5e-06,");
    assert_has(csv, "\n2,FAILED,,,,,,,0,0\n");
    assert_has(csv, "\n4,INTACT,4e-06,4.5e-06,");
    OWNED char *svg = whole_file(sample_path(folder, "surface-point-1-replica-1-2.svg"));
    assert_has(svg, "90.00 \u00b5s: 24 fragments (dust: 24)</text>"); /* everything is broken */
}

/* ---- a body in space ---- */

static const double thickness = 0.02;

static fracas_err get_octant(const void *context, size_t point, fracas_stored_mesh *mesh)
{
    const fracas_surface_fineness fineness = {.divisions = 4, .order = 2};
    const fracas_surface *surface;
    if (point != SURFACE) return FRACAS_OK;
    TRY(fracas_surface_octant(1, &fineness, &surface));
    body_copy(surface, mesh);
    return FRACAS_OK;
}

/* The octant's study: the sample's columns, and the thickness. */
static void make_octant_study(void)
{
    static const fracas_column column[] = {
        {"cohesive.law", "", "Law of the interfaces", true},
        {"geometry.thickness", "m", "Thickness of the shell", false}};
    static const fracas_value value[SAMPLE_POINTS][2] = {{{NAN, "nitsche"}, {NAN, ""}},
                                                         {{NAN, "nitsche"}, {thickness, ""}},
                                                         {{NAN, "linear"}, {NAN, ""}}};
    static const fracas_mesh_source octant = {get_octant, NULL};
    table.ncolumns = 2;
    table.column = column;
    for (int p = 0; p < SAMPLE_POINTS; p++) point_row[p].value = value[p];
    commit(4, 18); /* interfaces of 16 elements in a triangle */
    merge_with(&octant);
}

/* What is asked for arrives at the drawing: time, view, gaps, and the thickness of the point. */
static void bodies_are_drawn_as_asked_for(void **state)
{
    static const fracas_view view = {225, -30};
    static const double time = 9e-6;
    OWNED char *folder = strdup(sample_path(study, "drawn"));
    FRACAS_CLEARED(fracas_stored_mesh) mesh = {0};
    FRACAS_CLEARED(fracas_record) record;
    FRACAS_CLEARED(fracas_surface_state) now;
    make_octant_study();
    FILE *out = text_begin();
    const fracas_picture_request request = {.point = SURFACE,
                                            .replica = 1,
                                            .count = 1,
                                            .time = &time,
                                            .show = FRACAS_SHOW_MESH,
                                            .view = &view,
                                            .explode = 0.15,
                                            .folder = folder};
    OK(fracas_pictures_write(study, &request, out));
    OWNED char *said = text_end(out);
    OK(get_octant(NULL, SURFACE, &mesh));
    make_record(SURFACE, 1, 18, &record);
    OK(fracas_surface_state_create(&mesh, &record, time, &now));
    const fracas_surface_picture picture = {
        "Point 1, replica 1 at 9.000 \u00b5s", FRACAS_SHOW_MESH, 800, true, &view, 0.15, thickness};
    out = text_begin();
    fputs("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n", out);
    OK(fracas_surface_picture_write(&mesh, &now, &picture, out));
    OWNED char *wanted = text_end(out);
    OWNED char *svg = whole_file(sample_path(folder, "surface-point-1-replica-1-1.svg"));
    assert_string_equal(svg, wanted);
}

/* The page of the study has `part`, or has it not. */
static void page_has(const char *part, bool wanted)
{
    OWNED char *page = whole_file(sample_path(study, "report/index.html"));
    assert_int_equal(strstr(page, part) != NULL, wanted);
}

static void report(void)
{
    OWN(fracas_analysis) analysis;
    OK(fracas_analysis_create(study, NULL, NULL, &analysis));
    OK(fracas_report_write(analysis, study, NULL, 0));
}

static void the_report_shows_bodies_with_gaps(void **state)
{
    make_octant_study();
    report();
    page_has("Seen from the direction (1, 1, 1), each fragment moved by 0.1 of the way", true);
    page_has("<figure id=\"surface-point-1-6\">", true);
    page_has(" mm, fragments apart: 0.1</text>", true);
    page_has("class=\"shade\"", true);
    page_has("<a href=\"film-point-1.html\">", true);
}

static void the_report_shows_flat_surfaces_as_they_lie(void **state)
{
    commit(4, interfaces_of(&shape));
    merge_with(&source);
    report();
    page_has("<figure id=\"surface-point-1-6\">", true);
    page_has("Seen from", false);
    page_has("class=\"shade\"", false);
    page_has("fragments apart", false);
}

TESTS_EACH(set_up_surface, tear_down, meshes_come_back_bit_by_bit,
           order_of_segments_changes_no_mesh, without_surfaces_nothing_is_added,
           faulty_meshes_are_refused, faults_of_meshes, pictures_of_what_is_not_there,
           pictures_and_first_times, bodies_are_drawn_as_asked_for,
           the_report_shows_bodies_with_gaps, the_report_shows_flat_surfaces_as_they_lie)
