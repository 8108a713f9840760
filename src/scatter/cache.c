// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "scatter/cache.h"

#include "base/file.h"
#include "base/hash.h"

#include <dirent.h>
#include <fcntl.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { FORMAT_VERSION = 7, SAMPLES = 256, PIECES = 6, FILES_KEPT = 9 };

static uint64_t hash_double(uint64_t hash, double value)
{
    return hash_bytes(hash, &value, sizeof value);
}

// Settings are hashed number by number: the padding of a struct is not defined.
static uint64_t hash_settings(uint64_t hash, const struct solver_settings *s)
{
    const double numbers[] = {s->lmax,
                              s->levels,
                              s->suns,
                              s->zeniths,
                              s->azimuths,
                              s->first_refinement,
                              s->nodes_per_shell,
                              s->first_nodes_per_shell,
                              s->orders,
                              s->max_orders,
                              s->tolerance};
    return hash_bytes(hash, numbers, sizeof numbers);
}

static uint64_t hash_constituent(uint64_t hash, const struct optics *optics, int i)
{
    const struct constituent *c = &optics->medium->constituents[i];
    hash = hash_bytes(hash, &optics->scattering_per_m[i], sizeof(lanes));
    hash = hash_bytes(hash, &optics->extinction_per_m[i], sizeof(lanes));
    hash = hash_bytes(hash, optics->moment[i], sizeof optics->moment[i]);
    for (int s = 0; s <= SAMPLES; s++) {
        const double x = (double)s / SAMPLES;
        hash = hash_double(hash, profile_density(&c->profile, x * (optics->top_radius_m -
                                                                   optics->ground_radius_m)));
        hash = hash_double(hash, phase_value(&c->phase, 2 * x - 1));
    }
    return hash;
}

static uint64_t hash_inputs(const struct atmosphere *a, const struct solver_settings *settings)
{
    const struct optics *o = a->optics;
    uint64_t hash = hash_double(HASH_BEGIN, FORMAT_VERSION);
    hash = hash_settings(hash, settings);
    hash = hash_double(hash, o->ground_radius_m);
    hash = hash_double(hash, o->top_radius_m);
    hash = hash_double(hash, o->medium->star_angular_radius_rad);
    hash = hash_bytes(hash, o->wavelength_nm, sizeof o->wavelength_nm);
    hash = hash_bytes(hash, &o->ground_albedo, sizeof(lanes));
    hash = hash_bytes(hash, o->shell_of_altitude, sizeof o->shell_of_altitude);
    for (int nm = 360; nm < 830; nm++) { // as the colours sample it
        hash = hash_double(hash, spectrum_at(&o->medium->star_irradiance, nm + 0.5));
    }
    for (int i = 0; i < o->constituent_count; i++) {
        hash = hash_constituent(hash, o, i);
    }
    const struct table_size size = a->table.size;
    const double numbers[] = {o->constituent_count, size.altitudes, size.views, size.suns,
                              size.azimuths};
    return hash_bytes(hash, numbers, sizeof numbers);
}

struct header {
    char magic[8];
    uint64_t key;      // hash of the inputs
    uint64_t bytes;    // of what follows
    uint64_t checksum; // of what follows
    int64_t orders;
};

// The arrays of an atmosphere in the order in which the file has them.
struct piece {
    void *data;
    size_t size;
};

static size_t list_pieces(const struct atmosphere *a, struct piece pieces[PIECES])
{
    const struct moments *m = &a->solution.moments;
    const struct sunlight *sun = &a->solution.sun;
    const size_t points = (size_t)m->levels * (size_t)m->suns * (size_t)harmonic_count(m->lmax);
    pieces[0] = (struct piece){(void *)&a->bands, sizeof a->bands};
    pieces[1] = (struct piece){m->radiance, points * sizeof(lanes)};
    pieces[2] = (struct piece){m->irradiance, (size_t)m->suns * sizeof(lanes)};
    pieces[3] = (struct piece){sun->log_transmittance,
                               (size_t)sun->levels * (size_t)sun->columns * sizeof(lanes)};
    pieces[4] = (struct piece){sun->ground_irradiance, (size_t)sun->columns * sizeof(lanes)};
    pieces[5] = (struct piece){a->table.texels, table_texels(&a->table) * sizeof(float)};
    size_t bytes = 0;
    for (int p = 0; p < PIECES; p++) {
        bytes += pieces[p].size;
    }
    return bytes;
}

static char *cache_path(const struct atmosphere *a, uint64_t key)
{
    return mem_printf(a->ctx, "%s/atmosphere-%016llx.bin", a->ctx->cache_dir,
                      (unsigned long long)key);
}

static bool unpack(struct atmosphere *a, uint64_t key, const char *data, size_t size)
{
    struct piece pieces[PIECES];
    const size_t bytes = list_pieces(a, pieces);
    struct header header;
    if (size != sizeof header + bytes) {
        return false;
    }
    memcpy(&header, data, sizeof header);
    if (memcmp(header.magic, "TRLATMO", 8) != 0 || header.key != key || header.bytes != bytes ||
        header.checksum != hash_bytes(key, data + sizeof header, bytes)) {
        return false;
    }
    const char *at = data + sizeof header;
    for (int p = 0; p < PIECES; p++) {
        memcpy(pieces[p].data, at, pieces[p].size);
        at += pieces[p].size;
    }
    a->solution.orders = (int)header.orders;
    return true;
}

bool cache_load(struct atmosphere *a, const struct solver_settings *settings)
{
    const uint64_t key = hash_inputs(a, settings);
    char *path = cache_path(a, key);
    if (!path || access(path, F_OK) != 0) {
        mem_free(a->ctx, path);
        return false;
    }
    struct piece pieces[PIECES];
    char *data = NULL;
    size_t size = 0;
    // A cache that fails is worth one warning, not the errors of what it tried.
    const trl_context quiet = context_silenced(a->ctx);
    // One byte more than is right, so that a file that is too long is seen as damaged, not refused.
    const trl_result result = file_read(
        &quiet, path, list_pieces(a, pieces) + sizeof(struct header) + 4096, &data, &size);
    const bool is_loaded = result == TRL_OK && unpack(a, key, data, size);
    if (!is_loaded) {
        trl_log(a->ctx, TRL_LOG_WARN, TRL_LOG_ITEM_CACHE,
                "%s is damaged; the atmosphere is solved again", path);
    }
    if (is_loaded) {
        (void)utimensat(AT_FDCWD, path, NULL, 0); // used now, so kept longest
    }
    mem_free(a->ctx, data);
    mem_free(a->ctx, path);
    return is_loaded;
}

// Removes the files that were used longest ago, so that scenes in the making do not fill the disk.
static void evict(const struct atmosphere *a)
{
    for (;;) {
        DIR *folder = opendir(a->ctx->cache_dir);
        char oldest[sizeof((struct dirent *)0)->d_name] = "";
        struct timespec oldest_time = {0};
        int count = 0;
        for (struct dirent *entry; folder && (entry = readdir(folder));) {
            struct stat info;
            if (strncmp(entry->d_name, "atmosphere-", 11) != 0 ||
                fstatat(dirfd(folder), entry->d_name, &info, 0) != 0 || !S_ISREG(info.st_mode)) {
                continue;
            }
            count++;
            if (count == 1 || info.st_mtim.tv_sec < oldest_time.tv_sec) {
                oldest_time = info.st_mtim;
                memcpy(oldest, entry->d_name, sizeof oldest);
            }
        }
        const bool is_removed = count > FILES_KEPT && unlinkat(dirfd(folder), oldest, 0) == 0;
        if (folder) {
            closedir(folder);
        }
        if (!is_removed) {
            return;
        }
    }
}

void cache_store(const struct atmosphere *a, const struct solver_settings *settings)
{
    const uint64_t key = hash_inputs(a, settings);
    struct piece pieces[PIECES];
    const size_t bytes = list_pieces(a, pieces);
    char *path = cache_path(a, key);
    char *data = mem_alloc(a->ctx, sizeof(struct header) + bytes, 1);
    const trl_context quiet = context_silenced(a->ctx);
    trl_result result = path && data ? file_make_dirs(&quiet, a->ctx->cache_dir) : TRL_ERROR_MEMORY;
    if (result == TRL_OK) {
        char *at = data + sizeof(struct header);
        for (int p = 0; p < PIECES; p++) {
            memcpy(at, pieces[p].data, pieces[p].size);
            at += pieces[p].size;
        }
        struct header header = {.magic = "TRLATMO",
                                .key = key,
                                .bytes = bytes,
                                .checksum = hash_bytes(key, data + sizeof header, bytes),
                                .orders = a->solution.orders};
        memcpy(data, &header, sizeof header);
        evict(a);
        result = file_write(&quiet, path, data, sizeof header + bytes);
    }
    if (result != TRL_OK) {
        trl_log(a->ctx, TRL_LOG_WARN, TRL_LOG_ITEM_CACHE,
                "the solved atmosphere could not be kept in %s; the next start takes as long",
                a->ctx->cache_dir);
    }
    mem_free(a->ctx, data);
    mem_free(a->ctx, path);
}
