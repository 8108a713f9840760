// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Tiles on the GPU: a shader finds the texel of any place and level in the atlas, or of the nearest
// ancestor that is there, without a seam between tiles.
#include "fixture.h"
#include "gpu/pass.h"
#include "terrain/atlas.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

// Places and levels looked up in one draw, and what came.
enum { QUERIES = 4096, QUERY_ROW = 64 };
struct lookup {
    struct gpu_texture queries, values;
    struct gpu_target target;
    struct gpu_program program;
    float query[QUERIES][4], value[QUERIES][4];
};

// 2166 columns halve to 1083, 542, 271, 136: no neat twos anywhere.
static const struct raster_place GLOBE = {-180, 90, 360.0 / 2166, 2166, 1083};

// Linear, so that all levels and filters have it; it jumps at the antimeridian.
static double ramp(double latitude, double longitude)
{
    return 50 * longitude + 20 * latitude;
}

static void lookup_init(const struct fixture *f, struct lookup *l)
{
    struct gpu_texture_desc desc = gpu_texture_desc_default();
    desc.width = QUERY_ROW;
    desc.height = QUERIES / QUERY_ROW;
    desc.format = GPU_FORMAT_RGBA32F;
    desc.filter = GPU_FILTER_NEAREST;
    assert_int_equal(gpu_texture_init(f->gpu, &desc, &l->queries), TRL_OK);
    assert_int_equal(gpu_texture_init(f->gpu, &desc, &l->values), TRL_OK);
    const struct gpu_target_desc target = {.color_count = 1, .colors = {{.texture = &l->values}}};
    assert_int_equal(gpu_target_init(f->gpu, &target, &l->target), TRL_OK);
    setenv("TRL_SHADER_DIR", TEST_SHADER_DIR, 1);
    const struct gpu_program_desc program = {.vertex = "lib/fullscreen.vert",
                                             .fragment = "pages.frag"};
    assert_int_equal(gpu_program_init(f->gpu, &program, &l->program), TRL_OK);
    unsetenv("TRL_SHADER_DIR");
}

static void lookup_finish(struct lookup *l)
{
    gpu_program_finish(&l->program);
    gpu_target_finish(&l->target);
    gpu_texture_finish(&l->queries);
    gpu_texture_finish(&l->values);
}

static void look_up(const struct fixture *f, const struct atlas *atlas, struct lookup *l)
{
    const struct gpu_region all = gpu_texture_region(&l->queries, 0);
    float paging[4];
    atlas_describe(atlas, 0, paging);
    assert_int_equal(gpu_texture_upload(&l->queries, &all, l->query), TRL_OK);
    gpu_program_set_texture(&l->program, "u_queries", &l->queries);
    gpu_program_set_texture(&l->program, "u_pages", &atlas->pages);
    gpu_program_set_texture(&l->program, "u_tiles", &atlas->textures[0].texture);
    gpu_program_set_vec4(&l->program, "u_paging", paging);
    const struct gpu_pass pass = {.target = &l->target};
    gpu_pass_begin(f->gpu, &pass);
    assert_int_equal(gpu_draw_fullscreen(&l->program, "look-up"), TRL_OK);
    assert_int_equal(gpu_texture_read(&l->values, &all, l->value), TRL_OK);
}

struct planet {
    struct pyramid pyramid;
    struct pyramid_reader reader;
    struct atlas atlas;
    struct lookup *lookup;
};

static void planet_init(const struct fixture *f, size_t tiles, struct planet *p)
{
    char path[128];
    fixture_write_heights(f, "globe", &GLOBE, ramp, path);
    struct raster raster;
    assert_int_equal(raster_open(f->ctx, path, &raster), TRL_OK);
    const struct pyramid_desc desc = {&raster, PYRAMID_INT16, true, true, true};
    assert_int_equal(pyramid_init(f->ctx, &desc, &p->pyramid), TRL_OK);
    raster_finish(&raster);
    assert_int_equal(pyramid_reader_init(f->ctx, &p->pyramid, &p->reader), TRL_OK);
    const size_t texel = f->gpu->caps.has_norm16 ? 2 : 4;
    const struct atlas_desc atlas = {1, {&p->pyramid}, tiles * PYRAMID_TEXELS * texel};
    assert_int_equal(atlas_init(f->gpu, &atlas, &p->atlas), TRL_OK);
    p->lookup = calloc(1, sizeof *p->lookup);
    lookup_init(f, p->lookup);
}

static void planet_finish(struct planet *p)
{
    lookup_finish(p->lookup);
    free(p->lookup);
    atlas_finish(&p->atlas);
    pyramid_reader_finish(&p->reader);
    pyramid_finish(&p->pyramid);
}

static bool put(struct planet *p, uint32_t level, uint32_t x, uint32_t y)
{
    static int16_t texels[PYRAMID_TEXELS];
    const struct pyramid_tile tile = {level, x, y};
    bool is_put = false;
    assert_int_equal(pyramid_read(&p->reader, &tile, texels), TRL_OK);
    assert_int_equal(atlas_put(&p->atlas, 0, &tile, texels, &is_put), TRL_OK);
    return is_put;
}

// Fills the queries with places all over, less than half a texel of `margin_level` from borders
// left out, all of one level.
static void ask_everywhere(struct planet *p, uint32_t level, uint32_t margin_level)
{
    const double margin = 0.5 / p->pyramid.levels[margin_level].height;
    for (int i = 0; i < QUERIES; i++) {
        const double u = fmod(i * 0.618033988749895, 1), v = fmod(i * 0.7548776662466927, 1);
        p->lookup->query[i][0] = (float)(margin + u * (1 - 2 * margin));
        p->lookup->query[i][1] = (float)(margin + v * (1 - 2 * margin));
        p->lookup->query[i][2] = (float)level;
    }
}

static double value_of(const struct planet *p, int i)
{
    const double held = (double)p->lookup->value[i][0];
    const bool is_norm = p->atlas.textures[0].texture.format == GPU_FORMAT_R16;
    return is_norm ? held * UINT16_MAX + INT16_MIN : held;
}

// Every place has the ramp, to the rounding of texels at each of `level` reductions, and that of
// filters: weights of 8 bits between texels of `level`.
static void expect_ramp(const struct planet *p, uint32_t level)
{
    const double texel = 50 * 360.0 / p->pyramid.levels[level].width;
    for (int i = 0; i < QUERIES; i++) {
        const float *q = p->lookup->query[i];
        const double wanted = ramp(90 - 180.0 * (double)q[1], -180 + 360.0 * (double)q[0]);
        assert_close(value_of(p, i), wanted, 0.6 + 0.5 * level + texel / 128);
    }
}

static void places_are_found_at_every_level(void **state)
{
    const struct fixture *f = *state;
    struct planet p = {0};
    planet_init(f, 100, &p);
    if (!f->gpu->caps.has_norm16 && !f->gpu->caps.has_float_linear) {
        planet_finish(&p); // nothing filters these texels but layers.glsl
        return;
    }
    for (uint32_t level = p.pyramid.level_count; level-- > 0;) {
        for (uint32_t y = 0; y < p.pyramid.levels[level].rows; y++) {
            for (uint32_t x = 0; x < p.pyramid.levels[level].columns; x++) {
                assert_true(put(&p, level, x, y));
            }
        }
    }
    assert_int_equal(atlas_commit(&p.atlas), TRL_OK);
    for (uint32_t level = 0; level < p.pyramid.level_count; level++) {
        ask_everywhere(&p, level, level);
        look_up(f, &p.atlas, p.lookup);
        expect_ramp(&p, level);
    }
    planet_finish(&p);
}

static void ancestors_stand_in(void **state)
{
    const struct fixture *f = *state;
    struct planet p = {0};
    planet_init(f, 100, &p);
    if (!f->gpu->caps.has_norm16 && !f->gpu->caps.has_float_linear) {
        planet_finish(&p);
        return;
    }
    const uint32_t last = p.pyramid.level_count - 1;
    assert_true(put(&p, last, 0, 0));
    assert_true(put(&p, 2, 1, 1));
    assert_true(put(&p, 1, 0, 0));
    assert_true(put(&p, 0, 5, 2)); // below tile 2, 1 of level 1, which is not there
    assert_int_equal(atlas_commit(&p.atlas), TRL_OK);
    // Whatever is asked for, the ramp is there, as fine as the last level at least; at the borders
    // that is coarse, too.
    for (uint32_t level = 0; level <= last; level++) {
        ask_everywhere(&p, level, last);
        look_up(f, &p.atlas, p.lookup);
        expect_ramp(&p, last);
    }
    planet_finish(&p);
}

static void what_a_frame_uses_stays(void **state)
{
    const struct fixture *f = *state;
    struct planet p = {0};
    planet_init(f, 1, &p); // the least there is
    const uint32_t slots = atlas_capacity(&p.atlas, 0), last = p.pyramid.level_count - 1;
    assert_int_equal(slots, 25);
    assert_true(put(&p, last, 0, 0));
    atlas_begin(&p.atlas);
    for (uint32_t i = 0; i < slots - 1; i++) {
        assert_true(put(&p, 0, i % 8, i / 8));
    }
    assert_false(put(&p, 0, 0, 4)); // all are used
    atlas_begin(&p.atlas);
    for (uint32_t i = 0; i < slots - 1; i++) {
        if (i != 7) {
            assert_true(atlas_touch(&p.atlas, 0, &(struct pyramid_tile){0, i % 8, i / 8}));
        }
    }
    assert_true(put(&p, 0, 0, 4));
    assert_true(atlas_touch(&p.atlas, 0, &(struct pyramid_tile){0, 0, 4}));
    assert_false(atlas_touch(&p.atlas, 0, &(struct pyramid_tile){0, 7, 0}));
    assert_false(put(&p, 0, 1, 4));
    // The last level's tile is never in the way, and never gone.
    for (int i = 0; i < 40; i++) {
        atlas_begin(&p.atlas);
        assert_true(put(&p, 1, (uint32_t)i % 4, (uint32_t)i / 4 % 3));
    }
    assert_true(atlas_touch(&p.atlas, 0, &(struct pyramid_tile){last, 0, 0}));
    planet_finish(&p);
}

static struct pyramid_tile tile_of(const struct planet *p, uint32_t index)
{
    const uint32_t columns = p->pyramid.levels[0].columns;
    return (struct pyramid_tile){0, index % columns, index / columns};
}

// Without using it.
static bool is_there(const struct planet *p, uint32_t index)
{
    const struct atlas_texture *t = &p->atlas.textures[0];
    const struct pyramid_tile wanted = tile_of(p, index);
    bool is_found = false;
    for (uint32_t i = 0; i < t->side * t->side; i++) {
        const struct pyramid_tile *tile = &t->slots[i].tile;
        is_found = is_found || (tile->x == wanted.x && tile->y == wanted.y);
    }
    return is_found;
}

// Tiles are used in another order than they came in; they go in that of their use.
static void the_longest_unused_goes_first(void **state)
{
    const struct fixture *f = *state;
    struct planet p = {0};
    planet_init(f, 1, &p);
    const uint32_t slots = atlas_capacity(&p.atlas, 0);
    const uint32_t all = p.pyramid.levels[0].columns * p.pyramid.levels[0].rows;
    for (uint32_t i = 0; i < slots; i++) {
        const struct pyramid_tile tile = tile_of(&p, i);
        atlas_begin(&p.atlas);
        assert_true(put(&p, 0, tile.x, tile.y));
    }
    for (uint32_t i = 0; i < slots; i++) {
        const struct pyramid_tile tile = tile_of(&p, i * 7 % slots);
        atlas_begin(&p.atlas);
        assert_true(atlas_touch(&p.atlas, 0, &tile));
    }
    assert_true(all > slots + 10);
    for (uint32_t i = 0; i < all - slots; i++) {
        const struct pyramid_tile tile = tile_of(&p, slots + i);
        atlas_begin(&p.atlas);
        assert_true(put(&p, 0, tile.x, tile.y));
        for (uint32_t k = 0; k < slots; k++) {
            assert_true(is_there(&p, k * 7 % slots) == (k > i));
        }
    }
    planet_finish(&p);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(places_are_found_at_every_level, fixture_set_up,
                                        fixture_tear_down),
        cmocka_unit_test_setup_teardown(ancestors_stand_in, fixture_set_up, fixture_tear_down),
        cmocka_unit_test_setup_teardown(what_a_frame_uses_stays, fixture_set_up, fixture_tear_down),
        cmocka_unit_test_setup_teardown(the_longest_unused_goes_first, fixture_set_up,
                                        fixture_tear_down),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
