// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "raster/beside.h"

#include <cpl_conv.h>
#include <cpl_string.h>
#include <string.h>
#include <strings.h>

bool beside_is_pointed_at(GDALDatasetH dataset)
{
    return GDALGetMetadataItem(dataset, "OVERVIEW_FILE", "OVERVIEWS") != NULL;
}

static bool is_plain_tiff(const char *path)
{
    static const char *const drivers[] = {"GTiff", NULL};
    const GDALDatasetH dataset =
        GDALOpenEx(path, GDAL_OF_RASTER | GDAL_OF_READONLY, drivers, NULL, NULL);
    const bool is_plain = dataset && !beside_is_pointed_at(dataset);
    if (dataset) {
        GDALClose(dataset);
    }
    return is_plain;
}

// GDAL looks for "a.tif.ovr" and "a.ovr", in capitals too, and for those of those.
static bool is_opened_with(const char *path, const char *name)
{
    const char *extension = CPLGetExtension(name);
    const bool is_kind = strcasecmp(extension, "ovr") == 0 || strcasecmp(extension, "msk") == 0;
    const char *own = CPLGetFilename(path);
    const size_t stem = strlen(CPLGetBasename(path));
    return is_kind && strcmp(name, own) != 0 && strncasecmp(name, own, stem) == 0 &&
           name[stem] == '.';
}

char *beside_find_stranger(const char *path)
{
    char *folder = CPLStrdup(CPLGetDirname(path));
    char **names = VSIReadDir(folder);
    char *found = NULL;
    for (int i = 0; names && names[i] && !found; i++) {
        char *file = CPLStrdup(CPLFormFilename(folder, names[i], NULL));
        if (is_opened_with(path, names[i]) && !is_plain_tiff(file)) {
            found = CPLStrdup(names[i]);
        }
        CPLFree(file);
    }
    CSLDestroy(names);
    CPLFree(folder);
    return found;
}
