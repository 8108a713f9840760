// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef TRL_RENDERER_H
#define TRL_RENDERER_H

/// @file
/// Pictures of a scene through OpenGL, without a window or in the caller's.
///
///     trl_renderer_desc desc = trl_renderer_desc_default();
///     desc.scene = scene;
///     trl_renderer_create(ctx, &desc, &renderer);
///     trl_renderer_draw(renderer, &view, 1920, 1080, 0);
///     trl_renderer_read_rgba8(renderer, pixels);
///
/// Exposure: a luminance of 1.2 * 2^EV100 cd m^-2 is mapped to 1 before the tone curve (ISO 2720
/// and ISO 12232 for a lens without losses at ISO 100); bright days are about EV100 15, moonlit
/// nights about -3.

#include <terrella/scene.h>

TRL_BEGIN

/// Everything needed to draw one scene: tables, rasters, programs, targets.
/// Owner: caller. Lifetime: destroy before its scene and context. Threads: all calls from the
/// thread that made it; a renderer of TRL_GL_CURRENT needs the context that was current then to be
/// current in every call, also in destroy. Renderers of TRL_GL_HEADLESS make their own context
/// current in each call, so several may live on one thread.
typedef struct trl_renderer trl_renderer;

/// Where OpenGL comes from.
typedef enum trl_gl {
    TRL_GL_HEADLESS, ///< a context of its own, without window or display (EGL)
    TRL_GL_CURRENT ///< the one that is current on the calling thread: OpenGL 3.3 core or ES 3.0, or
                   ///< later
} trl_gl;

enum {
    TRL_RENDERER_MAX_SIDE = 16384,     ///< of a picture, in pixels; the GL may allow less
    TRL_RENDERER_MAX_PIXELS = 1 << 26, ///< width times height: what fits into about 4 GB of targets
    TRL_RENDERER_MAX_WAVELENGTHS = 16  ///< of trl_renderer_desc.wavelengths
};

/// How the spectral model finds the light that the air adds; the others know one way each.
typedef enum trl_air {
    TRL_AIR_TABLE, ///< "table": looked up as solved for a smooth sphere
    TRL_AIR_MARCH ///< "march": the same, less the direct light that does not arrive because terrain
                  ///< stands before the star: shadows in the air
} trl_air;

/// The word for it on the command line; NULL for what is none. Threads: any.
TRL_API const char *trl_air_name(trl_air air);

/// How the mesh of the ground is made. All draw the same surface; they differ in where triangles
/// are, in time and in memory (docs/bench.md, terrain-error).
typedef enum trl_mesher {
    TRL_MESHER_HEMISPHERE, ///< "hemisphere": a grid that faces the camera, seen from the planet's
                           ///< centre (Michelic 2019)
    TRL_MESHER_PROJECTIVE, ///< "projective": a grid of rays around the camera, laid on the planet
                           ///< anew in every frame (planetary projective grid mapping)
    TRL_MESHER_QUADTREE,   ///< "quadtree": tiles that are split where the ground is near and rough
                           ///< (Schafhitzel 2007)
    TRL_MESHER_TESSELLATED ///< "tessellated": the grid of the hemisphere, divided and culled by the
                           ///< GPU's tessellation; needs OpenGL 4.0 or ES 3.2
} trl_mesher;

/// The word for it on the command line; NULL for what is none, as for the first number behind the
/// last mesher. Threads: any.
TRL_API const char *trl_mesher_name(trl_mesher mesher);

/// How the projective mesher places the rows of its grid, which go round the point below the
/// camera.
typedef enum trl_projective_rows {
    TRL_PROJECTIVE_ROWS_RELIEF, ///< "relief": close where ground that is in the picture bends
    TRL_PROJECTIVE_ROWS_SPHERES ///< "spheres": by rays that meet two reference spheres, as the
                                ///< paper has it; made for views from above
} trl_projective_rows;

enum { TRL_PROJECTIVE_MIN_SIDE = 16, TRL_PROJECTIVE_MAX_SIDE = 2048 };

/// The grid of TRL_MESHER_PROJECTIVE, of any size beside the picture's.
typedef struct trl_projective_desc {
    uint32_t columns, rows; ///< even, [TRL_PROJECTIVE_MIN_SIDE, TRL_PROJECTIVE_MAX_SIDE]
    trl_projective_rows placing;
} trl_projective_desc;

/// trl_renderer_desc.mesh_error_px.
#define TRL_MESH_ERROR_MIN_PX 0.1
#define TRL_MESH_ERROR_MAX_PX 100.0

/// trl_renderer_desc.sky_model: what the scene asks for.
#define TRL_SKY_MODEL_OF_SCENE (-1)

typedef struct trl_renderer_desc {
    uint32_t canary;        ///< set by trl_renderer_desc_default(); never touch
    const trl_scene *scene; ///< must outlive the renderer
    trl_gl gl;              ///< default TRL_GL_HEADLESS
    uint32_t wavelengths;   ///< to solve for, [1, TRL_RENDERER_MAX_WAVELENGTHS]; default 16
    trl_spectrum spectrum;  ///< of TRL_SKY_SPECTRAL; default TRL_SPECTRUM_FULL
    uint32_t max_orders;    ///< of TRL_SKY_SPECTRAL: scatterings and reflections by the ground that
                            ///< light may have, at most TRL_SKY_MAX_ORDERS; 0 (default): all
    int sky_model;          ///< a trl_sky_model, or TRL_SKY_MODEL_OF_SCENE (default)
    trl_air air;            ///< default TRL_AIR_MARCH
    trl_mesher mesher;      ///< default TRL_MESHER_QUADTREE
    trl_projective_desc projective; ///< of TRL_MESHER_PROJECTIVE; default 400 x 400, by relief
    double mesh_error_px; ///< of TRL_MESHER_QUADTREE: the error of the mesh that may be seen, in
                          ///< pixels, [TRL_MESH_ERROR_MIN_PX, TRL_MESH_ERROR_MAX_PX]; default 1.25
    const trl_rayleigh_desc *rayleigh; ///< for TRL_SKY_RAYLEIGH; copied; NULL (default): as the
                                       ///< scene asks
    bool measures_time;     ///< each draw waits for the GPU and fills trl_renderer_timings; default
                            ///< false
    bool waits_for_rasters; ///< of rasters that are held in tiles (trl_context_desc.raster_mb):
                            ///< each draw reads all that it shows (default). False: it draws
                            ///< with what is there, coarser, while threads read on; see
                            ///< trl_renderer_is_settled
} trl_renderer_desc;

/// A desc with every default set; the caller adds the scene. Threads: any.
TRL_API trl_renderer_desc trl_renderer_desc_default(void);

/// Solves the atmosphere or loads it from the context's cache folder, loads the scene's rasters and
/// compiles programs. Blocks for up to some seconds and tells the context's progress function how
/// far it is. A missing raster is an error unless its layer is optional; one that is there but no
/// good is told in a line of the log and left out.
/// @param[out] out  new renderer, or NULL on failure
/// @return TRL_OK; TRL_ERROR_INVALID (argument, or a file's content); TRL_ERROR_MEMORY;
/// TRL_ERROR_IO (raster);
///         TRL_ERROR_GPU; TRL_ERROR_UNSUPPORTED (no GL of the kind that is needed);
///         TRL_ERROR_CANCELLED
TRL_API TRL_MUST_USE trl_result trl_renderer_create(trl_context *ctx, const trl_renderer_desc *desc,
                                                    trl_renderer **out);

/// Frees *renderer and sets it to NULL.
TRL_API void trl_renderer_destroy(trl_renderer **renderer);

/// Draws the scene into the renderer's own targets, which follow the size; nothing is allocated
/// while it stays the same. Does not wait for the GPU. In a shared context all GL state that it
/// touches is left changed: the caller sets what it needs afterwards. A camera below the ground, or
/// less than a centimetre above it, is lifted to that height.
/// @param view       every number finite; ranges as in trl_view, altitude up to 10000 radii, EV
/// within 64 of 0
/// @param width      [1, TRL_RENDERER_MAX_SIDE], with height at most TRL_RENDERER_MAX_PIXELS
/// @param elapsed_s  since the last frame: automatic exposure follows the picture within about a
/// second of it.
///                   0: a single frame, exposed at once for what it shows
/// @return TRL_OK; TRL_ERROR_INVALID (size or view, named in the log; nothing was drawn);
/// TRL_ERROR_MEMORY;
///         TRL_ERROR_GPU
TRL_API TRL_MUST_USE trl_result trl_renderer_draw(trl_renderer *renderer, const trl_view *view,
                                                  uint32_t width, uint32_t height,
                                                  double elapsed_s);

/// Copies the tone-mapped picture into a rectangle of the default framebuffer of the current
/// context, scaled when the sizes differ. Pixels from the lower left corner; width and height at
/// least 1.
/// @return TRL_OK; TRL_ERROR_INVALID (nothing drawn yet; rectangle beyond TRL_RENDERER_MAX_SIDE);
/// TRL_ERROR_GPU
TRL_API TRL_MUST_USE trl_result trl_renderer_present(trl_renderer *renderer, uint32_t x, uint32_t y,
                                                     uint32_t width, uint32_t height);

/// Reads the tone-mapped picture as 8-bit sRGB, alpha 255, top row first. Waits for the GPU.
/// @param[out] rgba  width x height x 4 bytes, sizes of the last draw
/// @return TRL_OK; TRL_ERROR_INVALID (nothing drawn yet); TRL_ERROR_MEMORY; TRL_ERROR_GPU
TRL_API TRL_MUST_USE trl_result trl_renderer_read_rgba8(trl_renderer *renderer, uint8_t *rgba);

/// Reads the picture before exposure: linear sRGB primaries in cd m^-2, alpha 1, top row first,
/// finite. Colours outside the gamut have negative components. Waits for the GPU.
/// @param[out] rgba  width x height x 4 floats, sizes of the last draw
/// @return as trl_renderer_read_rgba8
TRL_API TRL_MUST_USE trl_result trl_renderer_read_radiance(trl_renderer *renderer, float *rgba);

/// Waits until everything asked for is drawn. For timing.
TRL_API void trl_renderer_wait(trl_renderer *renderer);

/// The EV100 with which the last frame was exposed, without the view's bias. Waits for the GPU.
/// @param[out] ev100  finite
/// @return TRL_OK; TRL_ERROR_INVALID (nothing drawn yet); TRL_ERROR_GPU
TRL_API TRL_MUST_USE trl_result trl_renderer_exposure(trl_renderer *renderer, double *ev100);

/// Altitude of the ground (or of the sea's surface) above the reference sphere, in metres; 0 where
/// the scene has no elevation. Any finite longitude; latitude in [-pi/2, pi/2].
TRL_API double trl_renderer_ground_altitude_m(const trl_renderer *renderer, double latitude_rad,
                                              double longitude_rad);

/// The same view with the altitude counted from the reference sphere, lifted above the ground as
/// for a draw, and the star given by its subsolar point: what stays put when the camera moves on
/// from there.
/// @return TRL_OK; TRL_ERROR_INVALID (a field is out of range, named in the log)
TRL_API TRL_MUST_USE trl_result trl_renderer_resolve(const trl_renderer *renderer,
                                                     const trl_view *view, trl_view *out);

/// Draws with another model of the sky from the next frame on. The first time for each model makes
/// its tables and compiles its programs: blocks as trl_renderer_create. What was made is kept.
/// @return TRL_OK; TRL_ERROR_INVALID (none that pictures are made by); else as trl_renderer_create,
///         and the old model stays
TRL_API TRL_MUST_USE trl_result trl_renderer_set_sky_model(trl_renderer *renderer,
                                                           trl_sky_model model);

/// The model that frames are drawn with.
TRL_API trl_sky_model trl_renderer_sky_model(const trl_renderer *renderer);

/// How TRL_SKY_SINGLE finds the light of air and ground of a scene without surface layers: as every
/// model does, or on two spheres as in Schafhitzel 2007, to repeat its Table 2.
typedef enum trl_single_drawing {
    TRL_SINGLE_PIXELS,  ///< looked up for every pixel (default)
    TRL_SINGLE_SPHERES, ///< looked up for every fragment of tessellated spheres
    TRL_SINGLE_VERTICES ///< integrated at every vertex of the same spheres, without the 3D table
} trl_single_drawing;

enum { TRL_SINGLE_MAX_SIDE = 1024, TRL_SINGLE_MAX_STEPS = 1000 };

/// Sets it from the next frame on. Spheres show no star, and their outlines have corners; the other
/// models are not touched.
/// @param side   each sphere has side x side vertices, [3, TRL_SINGLE_MAX_SIDE]; not looked at for
///               TRL_SINGLE_PIXELS
/// @param steps  of each vertex' integral, [1, TRL_SINGLE_MAX_STEPS]; looked at only for
///               TRL_SINGLE_VERTICES
/// @return TRL_OK; TRL_ERROR_INVALID (an argument; the scene has surface layers)
TRL_API TRL_MUST_USE trl_result trl_renderer_set_single_drawing(trl_renderer *renderer,
                                                                trl_single_drawing drawing,
                                                                uint32_t side, uint32_t steps);

/// What becomes of one constituent of a scene's atmosphere.
typedef struct trl_constituent_change {
    size_t constituent; ///< index in the scene
    double amount;      ///< factor on its scattering and absorption, [0, 1e6]
    double asymmetry;   ///< g of its phase function, (-0.9999, 0.9999); NAN: as in the scene
} trl_constituent_change;

/// Goes over to the atmosphere of `scene` (its constituents and height; star, ground, surface and
/// radius stay those of the renderer's scene), with `count` changes. Does not wait: solving goes on
/// on threads of its own while draws show what there is. Another asymmetry shows at the next draw,
/// approximately; a draft of all follows, then the fine picture. A further call drops what is not
/// finished. Models without multiple scattering change at once.
/// @param scene    needs to live only until the call returns
/// @param changes  may be NULL when count is 0
/// @return TRL_OK; TRL_ERROR_INVALID (an index or a number out of range; an asymmetry for a phase
///         function without one); TRL_ERROR_MEMORY; TRL_ERROR_GPU
TRL_API TRL_MUST_USE trl_result
trl_renderer_change_atmosphere(trl_renderer *renderer, const trl_scene *scene,
                               const trl_constituent_change *changes, size_t count);

/// Whether draws show the atmosphere last changed to, as fine as it gets, and the last one all that
/// its rasters have. While it is false, drawing again can give a better picture.
TRL_API bool trl_renderer_is_settled(const trl_renderer *renderer);

/// What has become of rasters that are held in tiles, since the renderer was made.
typedef struct trl_tile_stats {
    uint64_t rasters; ///< held in tiles; 0: all others are 0, too
    uint64_t loaded;  ///< tiles read
    uint64_t failed;  ///< tiles that could not be read: coarser ones stand in
    uint64_t missing; ///< tiles that the last draw did without and are still to come
    double held_mb;   ///< on both sides, those of coarse levels included
    double most_mb;   ///< the most that the tiles in the CPU's memory ever were
    double read_s;    ///< of all threads together, reading and unpacking
} trl_tile_stats;

/// @param[out] out  filled
TRL_API void trl_renderer_tile_stats(const trl_renderer *renderer, trl_tile_stats *out);

/// Lets clouds come together over frames from the next one on: each marches a quarter of their rays
/// and takes the others from the frame before, as far as the same clouds were seen there. For
/// flights: a picture then depends on those before it. After a jump of camera, sun or time the next
/// frame is whole; after four frames without a move it is as if it were. A renderer begins without.
/// @return TRL_OK; TRL_ERROR_INVALID
TRL_API TRL_MUST_USE trl_result trl_renderer_accumulate_clouds(trl_renderer *renderer,
                                                               bool accumulates);

/// Finds the light of the air in another way from the next frame on, which compiles programs when
/// it is the first of that kind.
/// @return TRL_OK; TRL_ERROR_INVALID (there is no such way)
TRL_API TRL_MUST_USE trl_result trl_renderer_set_air(trl_renderer *renderer, trl_air air);

/// The way that frames are drawn with.
TRL_API trl_air trl_renderer_air(const trl_renderer *renderer);

/// Makes the mesh of the ground in another way from the next frame on. The first time for each
/// mesher builds its programs; what was made is kept. A scene without surface layers has no mesh,
/// and remembers the choice only.
/// @return TRL_OK; TRL_ERROR_INVALID (there is no such mesher); TRL_ERROR_UNSUPPORTED (the GL has
///         no tessellation); TRL_ERROR_MEMORY; TRL_ERROR_GPU; on failure the old one stays
TRL_API TRL_MUST_USE trl_result trl_renderer_set_mesher(trl_renderer *renderer, trl_mesher mesher);

/// The mesher that frames are drawn with.
TRL_API trl_mesher trl_renderer_mesher(const trl_renderer *renderer);

/// Makes the grid of TRL_MESHER_PROJECTIVE anew, with another size or other rows; does not go over
/// to that mesher.
/// @return TRL_OK; TRL_ERROR_INVALID (a side or a placing that cannot be); TRL_ERROR_MEMORY;
///         TRL_ERROR_GPU; on failure the old one stays
TRL_API TRL_MUST_USE trl_result trl_renderer_set_projective(trl_renderer *renderer,
                                                            const trl_projective_desc *desc);

/// Cells to a side of the grid of TRL_MESHER_HEMISPHERE and TRL_MESHER_TESSELLATED; the latter has
/// patches of 8 x 8 of them.
enum { TRL_HEMISPHERE_MIN_CELLS = 32, TRL_HEMISPHERE_MAX_CELLS = 2048, TRL_HEMISPHERE_STEP = 16 };

/// Makes that grid anew with another size; a renderer begins with 1312, tessellated with 800. Does
/// not go over to those meshers.
/// @param cells  a multiple of TRL_HEMISPHERE_STEP within the limits above
/// @return TRL_OK; TRL_ERROR_INVALID (a size that cannot be); TRL_ERROR_MEMORY; TRL_ERROR_GPU; on
///         failure the old one stays
TRL_API TRL_MUST_USE trl_result trl_renderer_set_hemisphere(trl_renderer *renderer, uint32_t cells);

/// The error of the mesh that TRL_MESHER_QUADTREE aims at from the next frame on. Less takes more
/// triangles, up to a budget above which the error grows.
/// @return TRL_OK; TRL_ERROR_INVALID (out of range, see trl_renderer_desc)
TRL_API TRL_MUST_USE trl_result trl_renderer_set_mesh_error(trl_renderer *renderer,
                                                            double error_px);

/// What the mesh of the last frame took.
typedef struct trl_mesh_stats {
    uint32_t triangles; ///< handed to the GPU
    uint32_t draws;     ///< calls that it took
    uint64_t bytes; ///< held by the mesher: vertices, indices, its own textures; not the rasters
} trl_mesh_stats;

/// @param[out] out  all 0 for a scene without surface layers, and before the first draw
/// @return TRL_OK; TRL_ERROR_INVALID
TRL_API TRL_MUST_USE trl_result trl_renderer_mesh_stats(const trl_renderer *renderer,
                                                        trl_mesh_stats *out);

/// How long one pass of the last frame took.
typedef struct trl_timing {
    const char *name; ///< "surface", "sky", …; lives as long as the library
    double gpu_ms;    ///< between its first and last command on the GPU; 0 without timer queries
    double cpu_ms;    ///< on the calling thread; software GL often draws one pass while the next is
                      ///< asked for
} trl_timing;

/// Times of the passes of the last frame, in order; none unless the renderer measures time.
/// @param[out] rows  the first `capacity` of them; may be NULL when capacity is 0
/// @return how many there are
TRL_API size_t trl_renderer_timings(const trl_renderer *renderer, trl_timing *rows,
                                    size_t capacity);

/// What OpenGL this machine offers without a window.
typedef struct trl_gpu_info {
    char vendor[128], renderer[128], version[128]; ///< as the driver says
    bool is_es;                                    ///< OpenGL ES
    bool is_software;                              ///< rasterised by the CPU
    bool has_clip_control, has_timer_query, has_tessellation, has_float_linear, has_debug;
    float max_anisotropy; ///< 1: none
    uint32_t max_texture_size, max_3d_size, max_array_layers;
} trl_gpu_info;

/// Makes a headless context, asks it, and frees it. Leaves no context current on this thread.
/// @return TRL_OK; TRL_ERROR_INVALID; TRL_ERROR_UNSUPPORTED (none that can be used);
/// TRL_ERROR_MEMORY
TRL_API TRL_MUST_USE trl_result trl_gpu_info_read(trl_context *ctx, trl_gpu_info *out);

TRL_END
#endif // TRL_RENDERER_H
