/* SPDX-License-Identifier: GPL-3.0-or-later */
/* HDF5's file driver over our own descriptor, and the opening and closing of files. */
#include "base/file.h"
#include "campaigns/store/datafile.h"
#include "campaigns/store/file/disk.h"
#include "campaigns/store/file/h5.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

typedef struct {
    H5FD_t base; /* HDF5's part, first */
    fracas_h5 *h5;
    haddr_t eoa, eof;
} driver_file;

typedef struct {
    fracas_h5 *h5;
} driver_info;

static H5FD_t *driver_open(const char *name, unsigned flags, hid_t fapl, haddr_t maximum)
{
    (void)name, (void)flags, (void)maximum;
    const driver_info *info = H5Pget_driver_info(fapl);
    driver_file *file = info ? calloc(1, sizeof *file) : NULL;
    if (!file) return NULL;
    file->h5 = info->h5;
    file->eof = info->h5->bytes;
    return &file->base;
}

static herr_t driver_close(H5FD_t *base)
{
    free(base);
    return 0;
}

static herr_t driver_query(const H5FD_t *base, unsigned long *flags)
{
    (void)base;
    *flags = H5FD_FEAT_AGGREGATE_METADATA | H5FD_FEAT_ACCUMULATE_METADATA | H5FD_FEAT_DATA_SIEVE |
             H5FD_FEAT_AGGREGATE_SMALLDATA | H5FD_FEAT_DEFAULT_VFD_COMPATIBLE;
    return 0;
}

static haddr_t driver_get_eoa(const H5FD_t *base, H5FD_mem_t type)
{
    (void)type;
    return ((const driver_file *)(const void *)base)->eoa;
}

static herr_t driver_set_eoa(H5FD_t *base, H5FD_mem_t type, haddr_t address)
{
    (void)type;
    ((driver_file *)(void *)base)->eoa = address;
    return 0;
}

static haddr_t driver_get_eof(const H5FD_t *base, H5FD_mem_t type)
{
    (void)type;
    return ((const driver_file *)(const void *)base)->eof;
}

static herr_t driver_read(H5FD_t *base, H5FD_mem_t type, hid_t transfer, haddr_t address,
                          size_t size, void *buffer)
{
    (void)type, (void)transfer;
    fracas_h5 *h5 = ((driver_file *)(void *)base)->h5;
    size_t got;
    if (!fracas_disk_read(h5->fd, address, buffer, size, &got)) {
        if (!h5->error) h5->error = errno;
        return -1;
    }
    memset((char *)buffer + got, 0, size - got); /* HDF5 may look beyond the end: zeros are there */
    return 0;
}

static herr_t driver_write(H5FD_t *base, H5FD_mem_t type, hid_t transfer, haddr_t address,
                           size_t size, const void *buffer)
{
    (void)type, (void)transfer;
    driver_file *file = (driver_file *)(void *)base;
    if (address + size > file->eof) file->eof = address + size;
    if (!file->h5->error && !fracas_disk_write(file->h5->fd, address, buffer, size))
        file->h5->error = errno;
    return 0; /* see h5.h */
}

static herr_t driver_truncate(H5FD_t *base, hid_t transfer, hbool_t closing)
{
    (void)transfer, (void)closing;
    driver_file *file = (driver_file *)(void *)base;
    if (!file->h5->writing || file->eof == file->eoa) return 0;
    if (!file->h5->error && ftruncate(file->h5->fd, (off_t)file->eoa) < 0) file->h5->error = errno;
    file->eof = file->eoa;
    return 0;
}

static const H5FD_class_t driver = {
    .name = "fracas",
    .maxaddr = INT64_MAX,
    .fc_degree = H5F_CLOSE_STRONG,
    .fapl_size = sizeof(driver_info),
    .open = driver_open,
    .close = driver_close,
    .query = driver_query,
    .get_eoa = driver_get_eoa,
    .set_eoa = driver_set_eoa,
    .get_eof = driver_get_eof,
    .read = driver_read,
    .write = driver_write,
    .truncate = driver_truncate,
    .fl_map = H5FD_FLMAP_DICHOTOMY,
};

/* File format of HDF5 1.10, whatever library is used: its metadata carry checksums, the older one's
 * do not. */
static bool make_access(fracas_h5 *h5, hid_t *list)
{
    driver_info info = {h5};
    *list = H5Pcreate(H5P_FILE_ACCESS);
    return *list >= 0 && H5Pset_driver(*list, h5->driver, &info) >= 0 &&
           H5Pset_libver_bounds(*list, H5F_LIBVER_V110, H5F_LIBVER_V110) >= 0 &&
           H5Pset_fclose_degree(*list, H5F_CLOSE_STRONG) >= 0;
}

/* No handler at exit: in a forked child it would write the parent's open files. Nothing needs it
 * here. */
static fracas_err start(fracas_h5 *h5, const char *path, bool writing)
{
    *h5 = FRACAS_H5_CLOSED;
    h5->path = path;
    h5->writing = writing;
    errno = 0; /* for fracas_h5_fail */
    (void)H5dont_atexit();
    if (H5open() >= 0 && H5Eset_auto2(H5E_DEFAULT, NULL, NULL) >= 0)
        h5->driver = H5FDregister(&driver);
    if (h5->driver < 0) return fracas_fail(FRACAS_ENVIRONMENT, "the HDF5 library does not start");
    return FRACAS_OK;
}

#define TEXT(x) #x
#define VERSION(major, minor, release) TEXT(major) "." TEXT(minor) "." TEXT(release)
const char fracas_hdf5_built[] = VERSION(H5_VERS_MAJOR, H5_VERS_MINOR, H5_VERS_RELEASE);

void fracas_hdf5_version(char text[32])
{
    unsigned major = 0, minor = 0, release = 0;
    if (H5get_libversion(&major, &minor, &release) < 0) major = 0;
    snprintf(text, 32, "%u.%u.%u", major, minor, release);
}

fracas_err fracas_h5_create(fracas_h5 *h5, const char *name, const char *path)
{
    TRY(start(h5, path, true));
    h5->fd = fracas_file_create(name);
    if (h5->fd < 0) return fracas_disk_fail("create", path);
    OWN_ID list = H5I_INVALID_HID;
    OWN_ID creation = H5I_INVALID_HID;
    if (make_access(h5, &list) && (creation = H5Pcreate(H5P_FILE_CREATE)) >= 0 &&
        H5Pset_obj_track_times(creation, false) >= 0)
        h5->id = H5Fcreate(name, H5F_ACC_TRUNC, creation, list);
    return h5->id < 0 ? fracas_h5_fail(h5, "start of the file") : FRACAS_OK;
}

fracas_err fracas_h5_open(fracas_h5 *h5, const char *path)
{
    TRY(start(h5, path, false));
    struct stat info;
    TRY(fracas_disk_open(path, &h5->fd));
    if (fstat(h5->fd, &info) < 0) return fracas_disk_fail("read", path);
    h5->bytes = (uint64_t)info.st_size;
    OWN_ID list = H5I_INVALID_HID;
    if (make_access(h5, &list)) h5->id = H5Fopen(path, H5F_ACC_RDONLY, list);
    return h5->id < 0 ? fracas_h5_fail(h5, "start of the file") : FRACAS_OK;
}

fracas_err fracas_h5_flush_close(fracas_h5 *h5)
{
    hid_t id = h5->id;
    h5->id = H5I_INVALID_HID;
    if (H5Fclose(id) < 0) h5->driver = H5I_INVALID_HID; /* HDF5 keeps the file, so the driver too */
    else if (!h5->error) return FRACAS_OK;
    return fracas_h5_fail(h5, "end of the file");
}

void fracas_h5_close(fracas_h5 *h5)
{
    if (h5->writing && !h5->error) h5->error = ECANCELED; /* given up: HDF5 may drop the rest */
    if (h5->id >= 0 && H5Fclose(h5->id) < 0) h5->driver = H5I_INVALID_HID;
    if (h5->driver >= 0) H5FDunregister(h5->driver);
    if (h5->fd >= 0) close(h5->fd);
    *h5 = FRACAS_H5_CLOSED;
}
