// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// The spectral model: all orders of scattering, solved once (scatter/), looked up per pixel.
// The maps are in spectral_maps.h; here they are drawn with.
#include "scatter/resolver.h"
#include "sky/eclipse.h"
#include "sky/ground_light.h"
#include "sky/march.h"
#include "sky/moonlight.h"
#include "sky/pixels.h"
#include "sky/spectral_maps.h"
#include "sky/spectral_sea.h"
#include "spectrum/cie.h"

#include <math.h>
#include <stdio.h>

// The programs that draw pixels.
struct spectral_programs {
    bool is_made;
    struct gpu_program air, star, ground_bare, ground_surface;
};

struct spectral {
    const trl_context *ctx;
    struct gpu *gpu;
    struct spectral_maps maps;
    struct sky_pixels pixels;
    // By trl_air and whether there are an eclipse and clouds; made when first asked for.
    struct spectral_programs programs[TRL_AIR_MARCH + 1][2][2];
    struct sky_eclipse eclipse;
    struct sky_march march;
    struct moonlight moonlight;
    struct spectral_sea sea;
    struct atmosphere_desc desc;
    struct resolver *resolver; // of a medium that was changed to, or NULL
};

static const char *const SOURCE_NAMES[] = {"u_source0", "u_source1", "u_source2", "u_source3",
                                           "u_source_multiple"};

static void finish_programs(struct spectral *sky)
{
    for (int i = 0; i < 4 * (TRL_AIR_MARCH + 1); i++) {
        struct spectral_programs *programs = &sky->programs[i / 4][i / 2 % 2][i % 2];
        gpu_program_finish(&programs->air);
        gpu_program_finish(&programs->star);
        gpu_program_finish(&programs->ground_bare);
        gpu_program_finish(&programs->ground_surface);
        programs->is_made = false;
    }
}

// What a picture has beside the air of the tables.
struct shades {
    bool has_march, has_eclipse, has_clouds;
};

struct variant {
    struct gpu_program *program;
    const char *fragment;
    const char *define;
};

static trl_result make_program(const struct spectral *sky, struct shades shades,
                               const struct variant *variant)
{
    char peaked[32];
    snprintf(peaked, sizeof peaked, "PEAKED_COUNT %d", sky->maps.atmosphere->peaked.count);
    const char *defines[6] = {peaked};
    size_t count = 1;
    if (variant->define) {
        defines[count++] = variant->define;
    }
    if (shades.has_march) {
        defines[count++] = "MARCH";
    }
    if (shades.has_eclipse) {
        defines[count++] = "ECLIPSE";
    }
    if (variant->program == &sky->programs[shades.has_march][shades.has_eclipse][shades.has_clouds]
                                 .ground_surface &&
        sky->pixels.has_sea) {
        defines[count++] = "SEA";
    }
    if (shades.has_clouds) {
        defines[count++] = "CLOUDS";
    }
    const struct gpu_program_desc desc = {.vertex = "lib/layer.vert",
                                          .fragment = variant->fragment,
                                          .defines = defines,
                                          .define_count = count};
    gpu_program_finish(variant->program); // what an attempt that failed has left
    return gpu_program_init(sky->gpu, &desc, variant->program);
}

static trl_result make_programs(struct spectral *sky, struct shades shades)
{
    struct spectral_programs *p =
        &sky->programs[shades.has_march][shades.has_eclipse][shades.has_clouds];
    const struct variant variants[] = {
        {&p->air, "sky/spectral/sky.frag", NULL},
        {&p->star, "sky/spectral/sky.frag", "STAR"},
        {&p->ground_bare, "sky/spectral/ground.frag", NULL},
        {&p->ground_surface, "sky/spectral/ground.frag", "SURFACE"},
    };
    trl_result result = TRL_OK;
    for (size_t i = 0; i < sizeof variants / sizeof *variants && result == TRL_OK; i++) {
        result = make_program(sky, shades, &variants[i]);
    }
    p->is_made = result == TRL_OK;
    return result;
}

static trl_result init(const struct sky_desc *desc, struct spectral *sky)
{
    sky->desc = atmosphere_desc_default();
    sky->desc.wavelengths = desc->wavelengths;
    sky->desc.orders = desc->orders;
    struct atmosphere *atmosphere = NULL;
    trl_result result = atmosphere_create(sky->ctx, desc->medium, &sky->desc, &atmosphere);
    if (result == TRL_OK) {
        result = spectral_maps_init(sky->gpu, atmosphere, &sky->maps);
    }
    if (result == TRL_OK) {
        const double disc_rad = sky->maps.atmosphere->solution.sun.disc_rad;
        result = sky_pixels_init(desc, disc_rad, &sky->pixels);
    }
    if (result == TRL_OK) {
        sky_march_init(&sky->pixels, &sky->march);
        spectral_sea_init(desc, &sky->sea);
        moonlight_init(desc, &sky->sea, &sky->moonlight);
        result = make_programs(sky, (struct shades){0});
    }
    return result;
}

static void spectral_destroy(void **self)
{
    struct spectral *sky = *self;
    resolver_destroy(&sky->resolver);
    spectral_sea_finish(&sky->sea);
    moonlight_finish(&sky->moonlight);
    sky_march_finish(&sky->march);
    sky_eclipse_finish(&sky->eclipse);
    finish_programs(sky);
    sky_pixels_finish(&sky->pixels);
    spectral_maps_finish(&sky->maps);
    mem_free(sky->ctx, sky);
    *self = NULL;
}

static trl_result spectral_create(const struct sky_desc *desc, void **self)
{
    const trl_context *ctx = desc->gpu->ctx;
    struct spectral *sky = mem_alloc(ctx, 1, sizeof *sky);
    *self = sky;
    if (!sky) {
        return TRL_ERROR_MEMORY;
    }
    sky->ctx = ctx;
    sky->gpu = desc->gpu;
    const trl_result result = init(desc, sky);
    if (result != TRL_OK) {
        spectral_destroy(self);
    }
    return result;
}

// Goes over to what the resolver has solved, if anything. The old maps stay where that fails.
static trl_result adopt_solved(struct spectral *sky)
{
    if (!sky->resolver) {
        return TRL_OK;
    }
    const bool is_done =
        resolver_is_done(sky->resolver); // before taking, so that nothing is missed
    struct atmosphere *solved = resolver_take(sky->resolver);
    if (is_done) {
        resolver_destroy(&sky->resolver);
    }
    if (!solved) {
        return TRL_OK;
    }
    struct spectral_maps maps;
    trl_result result = spectral_maps_init(sky->gpu, solved, &maps);
    if (result != TRL_OK) {
        return result;
    }
    const bool has_programs = maps.atmosphere->peaked.count == sky->maps.atmosphere->peaked.count;
    moonlight_drop(&sky->moonlight);
    spectral_sea_drop(&sky->sea);
    spectral_maps_finish(&sky->maps);
    sky->maps = maps;
    sky->pixels.top_radius_m = maps.atmosphere->optics->top_radius_m;
    sky_eclipse_finish(&sky->eclipse);
    sky_march_finish(&sky->march);
    sky_march_init(&sky->pixels, &sky->march);
    if (!has_programs) {
        finish_programs(sky);
        result = make_programs(sky, (struct shades){0});
    }
    return result;
}

// Another asymmetry shows at once; all else when it is solved.
static trl_result spectral_change(void *self, const struct medium *medium)
{
    struct spectral *sky = self;
    resolver_destroy(&sky->resolver);
    const size_t count = (size_t)sky->maps.atmosphere->optics->constituent_count;
    trl_result result = TRL_OK;
    if (medium->constituent_count == count) {
        result = spectral_maps_set_phases(&sky->maps, medium);
    }
    if (result == TRL_OK && medium->constituent_count == count && sky->moonlight.maps.atmosphere) {
        result = spectral_maps_set_phases(&sky->moonlight.maps, medium);
    }
    return result == TRL_OK ? resolver_start(sky->ctx, medium, &sky->desc, &sky->resolver) : result;
}

static bool spectral_is_settled(const void *self)
{
    const struct spectral *sky = self;
    return !sky->resolver;
}

// A bare sphere has no terrain that shades the air.
static struct shades find_shades(const struct spectral *sky, const struct sky_view *view)
{
    const bool has_eclipse = sky_eclipse_find(&sky->pixels, view->camera) >= 0;
    return (struct shades){.has_march =
                               view->air == TRL_AIR_MARCH &&
                               (has_eclipse || view->cloud_shade || !sky_view_is_bare(view)),
                           .has_eclipse = has_eclipse,
                           .has_clouds = view->cloud_shade != NULL};
}

// What shadows need more than the tables.
static unsigned find_sea_shades(const struct shades *shades)
{
    return (shades->has_eclipse ? SEA_ECLIPSED : 0u) | (shades->has_clouds ? SEA_CLOUDED : 0u);
}

static trl_result prepare_shades(struct spectral *sky, const struct sky_view *view)
{
    const struct shades shades = find_shades(sky, view);
    trl_result result = TRL_OK;
    if (!sky->programs[shades.has_march][shades.has_eclipse][shades.has_clouds].is_made) {
        result = make_programs(sky, shades);
    }
    return result == TRL_OK && view->air == TRL_AIR_MARCH ? spectral_maps_add_source(&sky->maps)
                                                          : result;
}

static trl_result spectral_prepare(void *self, const struct sky_view *view)
{
    struct spectral *sky = self;
    const struct camera *camera = view->camera;
    const double radius_m = sky_pixels_eye_radius(&sky->pixels, camera);
    const double sun_mu = vec3_dot(vec3_normalize(camera->position_m), camera->sun_direction);
    const double highest_m = fmax(view->highest_m, view->cloud_top_m);
    const struct spectral_eye eye = {radius_m, sun_mu, highest_m};
    const struct shades shades = find_shades(sky, view);
    trl_result result = adopt_solved(sky);
    if (result == TRL_OK) {
        result = prepare_shades(sky, view);
    }
    if (result == TRL_OK) {
        sky->eclipse.orders = (int)sky->desc.orders;
        result = sky_eclipse_update(&sky->pixels, camera, sky->maps.atmosphere, &sky->eclipse);
    }
    if (result == TRL_OK) {
        result = spectral_maps_update(&sky->maps, &eye);
    }
    if (result == TRL_OK) {
        result = spectral_sea_prepare(&sky->sea, &sky->maps, view, camera->sun_direction,
                                      find_sea_shades(&shades));
    }
    if (result == TRL_OK && view->moon.is_there) {
        result = spectral_sea_prepare(&sky->sea, &sky->maps, view, view->moon.sight.direction,
                                      shades.has_clouds ? SEA_CLOUDED : 0);
    }
    return result == TRL_OK ? moonlight_prepare(&sky->moonlight, &sky->maps, view) : result;
}

static struct sky_moon spectral_find_moon(const void *self, const struct camera *camera,
                                          double highest_m)
{
    const struct spectral *sky = self;
    return moonlight_find(&sky->moonlight, sky->maps.atmosphere, camera, highest_m);
}

static void set_sources(const void *self, struct gpu_program *program)
{
    const struct spectral *sky = self;
    spectral_maps_bind(&sky->maps, program);
    for (int c = 0; c < AERIAL_SOURCES; c++) {
        if (sky->maps.source[c].name) {
            gpu_program_set_texture(program, SOURCE_NAMES[c], &sky->maps.source[c]);
        }
    }
}

static trl_result spectral_shade(void *self, const struct sky_view *view)
{
    struct spectral *sky = self;
    const struct shades shades = find_shades(sky, view);
    if (!shades.has_march) {
        return TRL_OK;
    }
    const struct sky_march_source source = {.pixels = &sky->pixels,
                                            .peaked_count = sky->maps.atmosphere->peaked.count,
                                            .set_maps = set_sources,
                                            .self = sky,
                                            .eclipse = shades.has_eclipse ? &sky->eclipse : NULL};
    return sky_march_draw(&sky->march, &source, view);
}

// One kind of pixels.
static trl_result draw_kind(struct spectral *sky, struct gpu_program *program, enum sky_kind kind,
                            const struct sky_view *view)
{
    sky_set_bands(program, &sky->maps.atmosphere->bands, sky->maps.atmosphere->optics,
                  view->surface.lights_cd_m2);
    sky_set_primaries(program, (const double[]){1, 1, 1});
    spectral_maps_bind(&sky->maps, program);
    const struct shades shades = find_shades(sky, view);
    if (shades.has_march) {
        sky_march_bind(&sky->march, program);
    }
    if (shades.has_eclipse) {
        sky_eclipse_set(&sky->pixels, &sky->eclipse, view->camera, program);
    }
    if (shades.has_clouds && (kind == SKY_KIND_GROUND || kind == SKY_KIND_SEA)) {
        gpu_program_set_texture(program, "u_cloud_shade", view->cloud_shade);
        sky_pixels_set_deck(program, view);
    }
    return sky_pixels_draw(&sky->pixels, program, kind, view);
}

static void bind_air(const void *self, const struct sky_view *view, bool whole,
                     struct gpu_program *program)
{
    const struct spectral *sky = self;
    const struct atmosphere *a = sky->maps.atmosphere;
    sky_pixels_set_view(&sky->pixels, program, view);
    if (whole) {
        sky_set_bands(program, &a->bands, a->optics, 0);
        sky_set_primaries(program, (const double[]){1, 1, 1});
        spectral_maps_bind(&sky->maps, program);
    }
    const struct shades shades = find_shades(sky, view);
    if (whole && shades.has_march) {
        sky_march_bind(&sky->march, program);
    }
    if (whole && shades.has_eclipse) {
        sky_eclipse_set(&sky->pixels, &sky->eclipse, view->camera, program);
    }
}

static void bind_moon(const void *self, const struct sky_view *view, struct gpu_program *program)
{
    const struct spectral *sky = self;
    moonlight_bind(&sky->moonlight, &sky->pixels, view, program);
}

static struct sky_air spectral_get_air(const void *self, const struct sky_view *view)
{
    const struct spectral *sky = self;
    const struct shades shades = find_shades(sky, view);
    return (struct sky_air){.peaked_count = sky->maps.atmosphere->peaked.count,
                            .bands = &sky->maps.atmosphere->bands,
                            .has_march = shades.has_march,
                            .has_eclipse = shades.has_eclipse,
                            .bind = bind_air,
                            .bind_moon = view->moon.is_there ? bind_moon : NULL,
                            .self = self};
}

// In eclipses the star shows as far as its corona outshines 1 % of a sky in totality.
static const double CORONA_RADII = 30;

static trl_result spectral_draw(void *self, const struct sky_view *view)
{
    struct spectral *sky = self;
    const struct shades shades = find_shades(sky, view);
    struct spectral_programs *programs =
        &sky->programs[shades.has_march][shades.has_eclipse][shades.has_clouds];
    struct gpu_program *ground =
        sky_view_is_bare(view) ? &programs->ground_bare : &programs->ground_surface;
    const bool has_corona = shades.has_eclipse && sky->eclipse.corona > 0;
    sky->pixels.shown_rad = sky->pixels.disc_rad * (has_corona ? CORONA_RADII : 1);
    trl_result result = sky_pixels_sort(&sky->pixels, view);
    if (result == TRL_OK) {
        result = draw_kind(sky, &programs->air, SKY_KIND_AIR, view);
    }
    if (result == TRL_OK) {
        result = draw_kind(sky, &programs->star, SKY_KIND_STAR, view);
    }
    if (result == TRL_OK) {
        result = draw_kind(sky, ground, SKY_KIND_GROUND, view);
    }
    if (result == TRL_OK && sea_water_is_seen(&sky->sea.water, view)) {
        struct gpu_program *sea = &sky->sea.programs[find_sea_shades(&shades)];
        result = sea_water_reflect(&sky->sea.water, &sky->pixels, view);
        spectral_sea_set(&sky->sea, view, sea);
        result = result == TRL_OK ? draw_kind(sky, sea, SKY_KIND_SEA, view) : result;
    }
    return result == TRL_OK ? moonlight_draw(&sky->moonlight, &sky->pixels, view) : result;
}

const struct sky_model sky_spectral = {.create = spectral_create,
                                       .destroy = spectral_destroy,
                                       .prepare = spectral_prepare,
                                       .shade = spectral_shade,
                                       .draw = spectral_draw,
                                       .change = spectral_change,
                                       .is_settled = spectral_is_settled,
                                       .find_moon = spectral_find_moon,
                                       .get_air = spectral_get_air,
                                       .reads_sky_view = true};
