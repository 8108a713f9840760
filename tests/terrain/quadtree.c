// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// The quadtree mesh against the altitudes of the CPU, the hemisphere mesh and itself a moment ago:
// a small planet with rolling land and an inset, cameras where tiles, faces and layers meet.
#include "fixture.h"

#include "terrain/quadtree_refine.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const double R = 1e6;
static const double DEGREE = 3.14159265358979323846 / 180;
// What the mesher aims at, in pixels.
static const double ERROR_PX = MESHER_ERROR_PX;

// Smooth over the whole sphere, poles and antimeridian included: hills of four texels upon larger
// ones upon mountains.
static double globe_height(double latitude, double longitude)
{
    const struct vec3 d = vec3_from_lat_lon(latitude * DEGREE, longitude * DEGREE);
    const double mountains = sin(5 * d.x + 1) * cos(4 * d.y) + sin(6 * d.z) * cos(3 * d.x);
    const double hills = sin(31 * d.x + 9 * d.z) * sin(29 * d.y + 17 * d.z);
    const double rough = sin(141 * d.x + 60 * d.y) * sin(150 * d.z + 70 * d.y);
    return 2500 + 1000 * mountains + 500 * hills + 400 * rough;
}

static double inset_height(double latitude, double longitude)
{
    return 2500 + 700 * sin(latitude * 8) * cos(longitude * 7);
}

struct planet {
    struct fixture *f;
    struct surface surface;
    struct mesher *mesher;
    struct picture picture;
};

static void make_planet(struct fixture *f, trl_mesher kind, struct planet *p)
{
    char globe[128];
    char inset[128];
    const struct raster_place everywhere = {-180, 90, 0.5, 720, 360};
    const struct raster_place somewhere = {28, 42, 0.02, 200, 200};
    fixture_write_heights(f, "globe", &everywhere, globe_height, globe);
    fixture_write_heights(f, "inset", &somewhere, inset_height, inset);
    const struct surface_layer_desc layers[2] = {
        {.kind = SURFACE_ELEVATION, .path = globe, .scale = 1},
        {.kind = SURFACE_ELEVATION, .path = inset, .scale = 1, .feather_rad = DEGREE}};
    struct surface_desc desc = surface_desc_default();
    desc.radius_m = R;
    desc.layer_count = 2;
    desc.layers = layers;
    p->f = f;
    assert_int_equal(surface_init(f->gpu, &desc, &p->surface), TRL_OK);
    assert_int_equal(mesher_create(&p->surface, kind, &p->mesher), TRL_OK);
    fixture_picture_init(f, &p->picture);
}

static void destroy_planet(struct planet *p)
{
    fixture_picture_finish(p->f, &p->picture);
    mesher_destroy(&p->mesher);
    surface_finish(&p->surface);
}

// `height_m` above the ground there. At a pole the raster has a height for each longitude; they
// differ by 2 cm, so near the ground the camera stands beside it.
static struct camera place_camera(const struct planet *p, struct camera_place place,
                                  double height_m)
{
    place.latitude -= place.latitude == 90 && height_m < 10 ? 0.01 : 0;
    const struct vec3 up = vec3_from_lat_lon(place.latitude * DEGREE, place.longitude * DEGREE);
    place.radius_m = R;
    place.altitude_m = surface_altitude(&p->surface, up) + height_m;
    return fixture_camera(&place);
}

// Poles, antimeridian, a cap's corner and border, a corner of tiles, the inset's border and middle.
static const struct camera_place PLACES[] = {
    {.latitude = 90, .longitude = 20},       {.latitude = -89.9, .longitude = 130},
    {.latitude = 12, .longitude = 179.999},  {.latitude = 60, .longitude = 90.001},
    {.latitude = -59.99, .longitude = 7},    {.latitude = 30, .longitude = -45},
    {.latitude = 40, .longitude = 28.3},     {.latitude = 40, .longitude = 30},
    {.latitude = -59.998, .longitude = -180}};
enum { PLACE_COUNT = sizeof PLACES / sizeof PLACES[0] };

static void test_neighbours_share_their_sides(void **state)
{
    (void)state;
    enum { LEVEL = 2 };
    const int64_t scale = 1 << LEVEL;
    for (int32_t tile = 0; tile < TILES_COUNT; tile++) {
        const struct tiles_place root = tiles_root(tile);
        assert_int_equal(tiles_root_index(&root), tile);
        for (int32_t k = 0; k < 16 * 9; k++) {
            const struct tiles_place p = {root.face, LEVEL, 4 * root.x + k / 9 % 4,
                                          4 * root.y + k / 9 / 4};
            const int32_t dx = k % 3 - 1;
            const int32_t dy = k / 3 % 3 - 1;
            struct tiles_place n;
            if ((dx == 0 && dy == 0) || !tiles_neighbour(&p, dx, dy, &n)) {
                continue;
            }
            // Corners with one name: two of a side, one across a corner.
            int shared = 0;
            for (int32_t pair = 0; pair < 16; pair++) {
                const struct tiles_point a = {p.face, p.x + pair % 2, p.y + pair / 2 % 2};
                const struct tiles_point b = {n.face, n.x + pair / 4 % 2, n.y + pair / 8};
                const struct tiles_point an = tiles_point_name(&a, scale);
                const struct tiles_point bn = tiles_point_name(&b, scale);
                shared += an.face == bn.face && an.x == bn.x && an.y == bn.y;
            }
            assert_true(shared >= (dx == 0 || dy == 0 ? 2 : 1));
        }
    }
}

static void test_points_of_faces_are_the_same_places(void **state)
{
    (void)state;
    enum { SCALE = 4 };
    int compared = 0;
    for (int32_t k = 0; k < 4 * TILES_CAP_SIDE * SCALE; k++) {
        for (int32_t face = TILES_NORTH; face <= TILES_SOUTH; face++) {
            const struct tiles_point band = {TILES_BAND, k,
                                             face == TILES_NORTH ? TILES_BAND_ROWS * SCALE : 0};
            struct tiles_point cap;
            assert_true(tiles_point_on(&band, SCALE, face, &cap));
            const struct tiles_geo a =
                tiles_geo_at(TILES_BAND, (double)band.x / SCALE, (double)band.y / SCALE);
            const struct tiles_geo b =
                tiles_geo_at(face, (double)cap.x / SCALE, (double)cap.y / SCALE);
            const struct vec3 u = vec3_from_lat_lon(a.latitude_rad, a.longitude_rad);
            const struct vec3 v = vec3_from_lat_lon(b.latitude_rad, b.longitude_rad);
            assert_true(vec3_length(vec3_sub(u, v)) < 1e-14);
            compared++;
        }
    }
    assert_int_equal(compared, 2 * 4 * TILES_CAP_SIDE * SCALE);
}

static void test_viewpoints_are_mapped_back(void **state)
{
    (void)state;
    srand(3);
    for (int i = 0; i < 3000; i++) {
        const int32_t face = i % TILES_FACES;
        const double u = (double)tiles_width(face, 0) * rand() / RAND_MAX;
        const double v = (double)tiles_height(face, 0) * rand() / RAND_MAX;
        double uv[2];
        tiles_map_back(face, tiles_geo_at(face, u, v), u, uv);
        assert_close(uv[0], u, 1e-12);
        assert_close(uv[1], v, 1e-12);
    }
}

// Error of a pixel's position against the ground of the CPU, in pixels: the part of the difference
// in altitude that is seen from the side.
static double find_error_px(const struct planet *p, const struct camera *camera, const float *pixel)
{
    const struct vec3 v = {(double)pixel[0], (double)pixel[1], (double)pixel[2]};
    const struct vec3 at = vec3_add(camera->position_m, v);
    const double distance = vec3_length(v);
    const double off = vec3_length(at) - R - surface_altitude(&p->surface, at);
    const double seen = vec3_length(vec3_cross(vec3_normalize(at), vec3_scale(v, 1 / distance)));
    return fabs(off) * seen / distance / (2 * camera->tan_half_fov_y / PICTURE_SIDE);
}

static void test_pixels_lie_on_the_ground(void **state)
{
    struct planet p;
    make_planet(*state, TRL_MESHER_QUADTREE, &p);
    const double heights[] = {0.01, 1, 30, 800, 2e4, 3e5, 1e7};
    double squares = 0;
    int count = 0;
    for (size_t i = 0; i < 7 * PLACE_COUNT; i++) {
        struct camera_place place = PLACES[i % PLACE_COUNT];
        const double height = heights[i / PLACE_COUNT];
        place.heading = 50.0 * (double)i;
        place.fov = height > 1e6 ? 15 : 50;
        place.pitch = height > 1e4 ? -90 : -15;
        const struct camera camera = place_camera(&p, place, height);
        fixture_picture_draw(&p.picture, p.mesher, &camera);
        for (int k = 0; k < PICTURE_SIDE * PICTURE_SIDE; k += 41) {
            const float *pixel = p.picture.pixels + 4 * k;
            if (pixel[3] < -1e8f) {
                continue;
            }
            const double error = find_error_px(&p, &camera, pixel);
            // Samples of the error miss its largest, and at the corners of a picture a pixel is
            // smaller than in its middle.
            assert_true(error < 2 * ERROR_PX);
            squares += error * error;
            count++;
            const struct vec3 at = {(double)pixel[0], (double)pixel[1], (double)pixel[2]};
            const struct vec3 ray = fixture_ray(&camera, k % PICTURE_SIDE, k / PICTURE_SIDE);
            const double off = vec3_length(vec3_cross(ray, at)) / vec3_length(at);
            assert_true(off < 1e-4); // rasterised floats
        }
    }
    assert_true(count > 10000);
    assert_true(sqrt(squares / count) < 0.5);
    destroy_planet(&p);
}

// Whether a ray meets a sphere about the centre; from inside it always does.
static bool hits_sphere(const struct camera *camera, struct vec3 ray, double radius)
{
    const double b = vec3_dot(camera->position_m, ray);
    const double c = vec3_dot(camera->position_m, camera->position_m) - radius * radius;
    return c < 0 || (b < 0 && b * b - c > 0);
}

static bool is_ground(const struct picture *picture, int x, int y)
{
    return picture->pixels[4 * (y * PICTURE_SIDE + x) + 3] > -1e8f;
}

static void test_there_are_no_holes(void **state)
{
    struct planet p;
    make_planet(*state, TRL_MESHER_QUADTREE, &p);
    const double low = R + surface_min_altitude(&p.surface);
    const double high = R + surface_max_altitude(&p.surface);
    const double heights[] = {0.01, 2, 50, 3000, 3e4, 3e5, 2e6, 1e8};
    srand(7);
    for (size_t i = 0; i < 8 * PLACE_COUNT; i++) {
        struct camera_place place = PLACES[i % PLACE_COUNT];
        const double height = heights[i / PLACE_COUNT];
        place.heading = rand() % 360;
        place.fov = height > 1e7 ? 1.5 : 20 + rand() % 70;
        const double horizon = -acos(R / (R + height)) / DEGREE;
        place.pitch = i % 3 == 0 ? horizon : i % 3 == 1 ? -90 : horizon - rand() % 40;
        const struct camera camera = place_camera(&p, place, height);
        fixture_picture_draw(&p.picture, p.mesher, &camera);
        for (int y = 1; y < PICTURE_SIDE - 1; y++) {
            for (int x = 1; x < PICTURE_SIDE - 1; x++) {
                const struct vec3 ray = fixture_ray(&camera, x, y);
                if (is_ground(&p.picture, x, y)) {
                    assert_true(hits_sphere(&camera, ray, high));
                    continue;
                }
                assert_false(hits_sphere(&camera, ray, low));
                // Above the lowest ground, too, no pixel is missing from the midst of others.
                assert_false(is_ground(&p.picture, x - 1, y) && is_ground(&p.picture, x + 1, y) &&
                             is_ground(&p.picture, x, y - 1) && is_ground(&p.picture, x, y + 1));
            }
        }
    }
    destroy_planet(&p);
}

static void test_it_draws_what_the_hemisphere_draws(void **state)
{
    struct planet p;
    struct planet other;
    make_planet(*state, TRL_MESHER_QUADTREE, &p);
    make_planet(*state, TRL_MESHER_HEMISPHERE, &other);
    for (size_t i = 0; i < PLACE_COUNT; i++) {
        struct camera_place place = PLACES[i];
        place.heading = 77.0 * (double)i;
        place.fov = 50;
        place.pitch = -12;
        const struct camera camera = place_camera(&p, place, 2000);
        fixture_picture_draw(&p.picture, p.mesher, &camera);
        fixture_picture_draw(&other.picture, other.mesher, &camera);
        int different = 0;
        for (int k = 0; k < PICTURE_SIDE * PICTURE_SIDE; k++) {
            const float *a = p.picture.pixels + 4 * k;
            const float *b = other.picture.pixels + 4 * k;
            const struct vec3 u = {(double)a[0], (double)a[1], (double)a[2]};
            const struct vec3 v = {(double)b[0], (double)b[1], (double)b[2]};
            // Seen along the ground an error of a pixel is many times as long.
            const double near = fmin(vec3_length(u), vec3_length(v));
            different +=
                (a[3] > -1e8f) != (b[3] > -1e8f) || vec3_length(vec3_sub(u, v)) > 0.05 * near;
        }
        // Crests: a pixel that just misses one sees what is behind.
        assert_true(different < PICTURE_SIDE * PICTURE_SIDE / 50);
    }
    destroy_planet(&other);
    destroy_planet(&p);
}

// A vertex on the border of a square, by its name.
struct border_vertex {
    struct tiles_point name;
    struct vec3 at; // from the camera
};

static int compare_names(const void *a, const void *b)
{
    const struct tiles_point *p = &((const struct border_vertex *)a)->name;
    const struct tiles_point *q = &((const struct border_vertex *)b)->name;
    const int64_t difference = p->face != q->face ? p->face - q->face
                               : p->y != q->y     ? p->y - q->y
                                                  : p->x - q->x;
    return (difference > 0) - (difference < 0);
}

// As the shader has it: between three grids, by the level there.
static struct vec3 find_vertex(const struct quadtree_leaf *leaf, const struct quadtree_node *node,
                               float grids[QUADTREE_SIDE][QUADTREE_GRIDS][QUADTREE_SIDE][4],
                               const int32_t ij[2])
{
    const double fx = (double)ij[0] / QUADTREE_CELLS;
    const double fy = (double)ij[1] / QUADTREE_CELLS;
    const double lod = (1 - fy) * ((1 - fx) * leaf->lod[0] + fx * leaf->lod[1]) +
                       fy * ((1 - fx) * leaf->lod[2] + fx * leaf->lod[3]) - (node->place.level - 2);
    assert_true(lod > -1e-9 && lod < 2 + 1e-9);
    const int first = lod > 1 ? 0 : 1; // of the two grids between which it is
    const double weight = lod > 1 ? lod - 1 : lod;
    double at[3];
    for (int c = 0; c < 3; c++) {
        at[c] = weight * (double)grids[ij[1]][first][ij[0]][c] +
                (1 - weight) * (double)grids[ij[1]][first + 1][ij[0]][c];
    }
    return vec3_add(node->origin_m, (struct vec3){at[0], at[1], at[2]});
}

static size_t list_border(const struct quadtree_nodes *nodes, const struct quadtree_leaf *leaf,
                          struct border_vertex *out)
{
    static float grids[QUADTREE_SIDE][QUADTREE_GRIDS][QUADTREE_SIDE][4];
    const struct quadtree_node *node = &nodes->all[leaf->node];
    const int64_t finest = (int64_t)QUADTREE_CELLS << TILES_MAX_LEVEL;
    const int32_t up = TILES_MAX_LEVEL - node->place.level;
    size_t count = 0;
    quadtree_node_vertices(nodes, leaf->node, grids);
    for (int32_t k = 0; k < 4 * QUADTREE_SIDE; k++) {
        const int side = k / QUADTREE_SIDE;
        const int32_t along = k % QUADTREE_SIDE;
        if (leaf->is_coarser[side] && along % 2 == 1) {
            continue; // gives way to the one before
        }
        const int32_t end = side % 2 == 1 ? QUADTREE_CELLS : 0;
        const int32_t ij[2] = {side < 2 ? end : along, side < 2 ? along : end};
        const struct tiles_point point = {node->place.face,
                                          (node->place.x * QUADTREE_CELLS + ij[0]) << up,
                                          (node->place.y * QUADTREE_CELLS + ij[1]) << up};
        out[count++] = (struct border_vertex){tiles_point_name(&point, finest),
                                              find_vertex(leaf, node, grids, ij)};
    }
    return count;
}

static void test_neighbours_draw_the_same_border(void **state)
{
    struct planet p;
    make_planet(*state, TRL_MESHER_QUADTREE, &p);
    struct quadtree_nodes nodes;
    assert_int_equal(quadtree_nodes_init(&p.surface, &nodes), TRL_OK);
    struct quadtree_leaves *leaves = malloc(sizeof *leaves);
    struct border_vertex *border = malloc(sizeof *border * QUADTREE_MAX_LEAVES * 4 * QUADTREE_SIDE);
    assert_true(leaves && border);
    int shared = 0;
    int levels = 0;
    for (size_t i = 0; i < 3 * PLACE_COUNT; i++) {
        static const double HEIGHTS[3] = {20, 3000, 2e5};
        struct camera_place place = PLACES[i % PLACE_COUNT];
        place.fov = 40;
        place.pitch = -20;
        const struct camera camera = place_camera(&p, place, HEIGHTS[i / PLACE_COUNT]);
        assert_int_equal(quadtree_refine(&nodes, &camera, 3e-4, leaves), TRL_OK);
        size_t count = 0;
        for (uint32_t k = 0; k < leaves->count; k++) {
            const struct quadtree_leaf *leaf = &leaves->all[k];
            count += list_border(&nodes, leaf, border + count);
            levels += leaf->is_coarser[0] || leaf->is_coarser[2];
        }
        qsort(border, count, sizeof *border, compare_names);
        for (size_t k = 0; k + 1 < count; k++) {
            if (compare_names(&border[k], &border[k + 1]) != 0) {
                continue;
            }
            const double gap = vec3_length(vec3_sub(border[k].at, border[k + 1].at));
            const double distance = vec3_length(vec3_sub(border[k].at, camera.position_m));
            // Floats that count from the middles of squares, which may be as large as this.
            assert_true(gap < 1e-6 * (distance + 1));
            shared++;
        }
    }
    assert_true(shared > 10000 && levels > 100);
    free(border);
    free(leaves);
    quadtree_nodes_finish(&nodes);
    destroy_planet(&p);
}

// Whether all of a square lies beyond one side of the picture.
static bool is_outside(const struct quadtree_nodes *nodes, uint32_t index,
                       const struct camera *camera)
{
    static float grids[QUADTREE_SIDE][QUADTREE_GRIDS][QUADTREE_SIDE][4];
    const struct vec3 origin = vec3_sub(nodes->all[index].origin_m, camera->position_m);
    int beyond[4] = {0};
    quadtree_node_vertices(nodes, index, grids);
    for (int k = 0; k < QUADTREE_VERTICES; k++) {
        const float *v = grids[k / QUADTREE_SIDE][0][k % QUADTREE_SIDE];
        const struct vec3 at =
            vec3_add(origin, (struct vec3){(double)v[0], (double)v[1], (double)v[2]});
        const double z = vec3_dot(camera->forward, at);
        const double x = vec3_dot(camera->right, at) / camera->tan_half_fov_x;
        const double y = vec3_dot(camera->up, at) / camera->tan_half_fov_y;
        beyond[0] += x > z;
        beyond[1] += -x > z;
        beyond[2] += y > z;
        beyond[3] += -y > z;
    }
    for (int side = 0; side < 4; side++) {
        if (beyond[side] == QUADTREE_VERTICES) {
            return true;
        }
    }
    return false;
}

// Both stages of clipping: whole tiles, and squares down the tree.
static void test_what_is_out_of_view_is_clipped(void **state)
{
    static const double HEIGHTS[4] = {20, 3000, 2e5, 3e6};
    struct planet p;
    make_planet(*state, TRL_MESHER_QUADTREE, &p);
    struct quadtree_nodes nodes;
    assert_int_equal(quadtree_nodes_init(&p.surface, &nodes), TRL_OK);
    struct quadtree_leaves *leaves = malloc(sizeof *leaves);
    assert_non_null(leaves);
    for (size_t i = 0; i < 4; i++) {
        uint32_t tiles = 0, squares = 0, outside = 0;
        for (size_t k = 0; k < PLACE_COUNT; k++) {
            struct camera_place place = PLACES[k];
            place.fov = 40;
            place.pitch = i < 2 ? -5 : -60;
            const struct camera camera = place_camera(&p, place, HEIGHTS[i]);
            assert_int_equal(quadtree_refine(&nodes, &camera, 3e-4, leaves), TRL_OK);
            for (int32_t tile = 0; tile < TILES_COUNT; tile++) {
                tiles += nodes.all[quadtree_root(tile)].is_near;
            }
            squares += leaves->count;
            for (uint32_t n = 0; n < leaves->count; n++) {
                outside += is_outside(&nodes, leaves->all[n].node, &camera);
            }
        }
        printf("from %g m: %.1f tiles, %.0f squares, %.1f %% of them outside\n", HEIGHTS[i],
               1.0 * tiles / PLACE_COUNT, 1.0 * squares / PLACE_COUNT, 100.0 * outside / squares);
        // Half of all tiles are behind the horizon, most of the others beside the picture.
        assert_true(tiles < PLACE_COUNT * TILES_COUNT / 4);
        // Balls around squares reach out of them: few squares on a small planet, each as large as a
        // third of the picture, count most. Of Earth from a valley 2 % are outside.
        assert_true(outside < squares / 2);
    }
    free(leaves);
    quadtree_nodes_finish(&nodes);
    destroy_planet(&p);
}

// The largest change of the ground between two pictures taken straight down from one place, in
// pixels of the later one: altitudes of the first are looked up where its camera saw them.
static double find_change_px(const float *before, const struct camera *old_camera,
                             const struct picture *now, const struct camera *camera)
{
    double largest = 0;
    for (int k = 0; k < PICTURE_SIDE * PICTURE_SIDE; k += 7) {
        const float *pixel = now->pixels + 4 * k;
        const struct vec3 v = {(double)pixel[0], (double)pixel[1], (double)pixel[2]};
        const struct vec3 w = vec3_add(v, vec3_sub(camera->position_m, old_camera->position_m));
        const double z = vec3_dot(old_camera->forward, w) * old_camera->tan_half_fov_x;
        const double x = (vec3_dot(old_camera->right, w) / z + 1) / 2 * PICTURE_SIDE - 0.5;
        const double y = (vec3_dot(old_camera->up, w) / z + 1) / 2 * PICTURE_SIDE - 0.5;
        const int i = (int)floor(x);
        const int j = (int)floor(y);
        if (i < 0 || j < 0 || i + 1 >= PICTURE_SIDE || j + 1 >= PICTURE_SIDE) {
            continue;
        }
        const float *corner = before + 4 * (j * PICTURE_SIDE + i);
        const float *above = corner + 4 * PICTURE_SIDE;
        if (pixel[3] < -1e8f || corner[3] < -1e8f || corner[7] < -1e8f || above[3] < -1e8f ||
            above[7] < -1e8f) {
            continue;
        }
        const double fx = x - i;
        const double fy = y - j;
        const double was = (1 - fy) * ((1 - fx) * (double)corner[3] + fx * (double)corner[7]) +
                           fy * ((1 - fx) * (double)above[3] + fx * (double)above[7]);
        const double pixel_m = vec3_length(v) * 2 * camera->tan_half_fov_y / PICTURE_SIDE;
        largest = fmax(largest, fabs((double)pixel[3] - was) / pixel_m);
    }
    return largest;
}

static void test_a_descent_shows_no_jump(void **state)
{
    struct planet p;
    make_planet(*state, TRL_MESHER_QUADTREE, &p);
    const size_t bytes = (size_t)PICTURE_SIDE * PICTURE_SIDE * 4 * sizeof(float);
    float *before = malloc(bytes);
    assert_non_null(before);
    double largest = 0;
    for (size_t i = 0; i < PLACE_COUNT; i += 3) {
        struct camera_place place = PLACES[i];
        place.pitch = -90;
        place.fov = 20;
        struct camera old_camera = place_camera(&p, place, 3e5);
        fixture_picture_draw(&p.picture, p.mesher, &old_camera);
        for (double height = 3e5 * 0.98; height > 1000; height *= 0.98) {
            memcpy(before, p.picture.pixels, bytes);
            const struct camera camera = place_camera(&p, place, height);
            fixture_picture_draw(&p.picture, p.mesher, &camera);
            largest = fmax(largest, find_change_px(before, &old_camera, &p.picture, &camera));
            old_camera = camera;
        }
    }
    // A square goes over within half an octave of its distance, which is at least 7 of these steps
    // where mountains stand as high as the camera is above them; two levels may go over at once,
    // and a parent may be off by more than what is wanted of its children. A jump is the whole
    // error: 3 pixels where the morphing is taken out of the shader.
    printf("largest change: %.3f px\n", largest);
    assert_true(largest < 0.75);
    assert_true(largest > 0.001); // something does morph
    free(before);
    destroy_planet(&p);
}

static void test_a_camera_that_stays_makes_nothing_new(void **state)
{
    struct planet p;
    make_planet(*state, TRL_MESHER_QUADTREE, &p);
    struct camera_place place = PLACES[7];
    place.fov = 50;
    place.pitch = -10;
    const struct camera camera = place_camera(&p, place, 200);
    fixture_picture_draw(&p.picture, p.mesher, &camera);
    const uint32_t made = p.mesher->stats.projections;
    const uint32_t seen = p.mesher->stats.triangles;
    fixture_picture_draw(&p.picture, p.mesher, &camera);
    assert_int_equal(p.mesher->stats.projections, made);
    place.pitch = 89;
    const struct camera sky = place_camera(&p, place, 200);
    fixture_picture_draw(&p.picture, p.mesher, &sky);
    assert_true(p.mesher->stats.triangles < seen / 10);
    destroy_planet(&p);
}

static void test_less_error_takes_more_triangles(void **state)
{
    struct planet p;
    make_planet(*state, TRL_MESHER_QUADTREE, &p);
    struct camera_place place = PLACES[7];
    place.fov = 4; // the inset, magnified: its hills decide;
    place.pitch = -89;
    const struct camera camera = place_camera(&p, place, 1e5);
    uint32_t triangles[2];
    double worst[2] = {0, 0};
    for (int i = 0; i < 2; i++) {
        p.mesher->error_px = i == 0 ? 4 : 0.5;
        fixture_picture_draw(&p.picture, p.mesher, &camera);
        triangles[i] = p.mesher->stats.triangles;
        for (int k = 0; k < PICTURE_SIDE * PICTURE_SIDE; k += 41) {
            const float *pixel = p.picture.pixels + 4 * k;
            if (pixel[3] > -1e8f) {
                worst[i] = fmax(worst[i], find_error_px(&p, &camera, pixel));
            }
        }
    }
    assert_true(triangles[1] > 3 * triangles[0] / 2);
    assert_true(worst[1] < 1 && worst[1] < worst[0]);
    // What cannot be reached is not tried: the squares that are in view have a budget, and about as
    // many are chosen.
    p.mesher->error_px = 1e-3;
    fixture_picture_draw(&p.picture, p.mesher, &camera);
    assert_true(p.mesher->stats.chunks > 150 && p.mesher->stats.chunks < 700);
    destroy_planet(&p);
}

static void test_more_squares_than_are_kept_come_and_go(void **state)
{
    struct planet p;
    make_planet(*state, TRL_MESHER_QUADTREE, &p);
    struct camera_place place = PLACES[7];
    place.fov = 60;
    place.pitch = -20;
    const struct camera first = place_camera(&p, place, 100);
    fixture_picture_draw(&p.picture, p.mesher, &first);
    const size_t count = (size_t)PICTURE_SIDE * PICTURE_SIDE;
    float *before = malloc(count * 4 * sizeof *before);
    assert_non_null(before);
    memcpy(before, p.picture.pixels, count * 4 * sizeof *before);
    for (int i = 0; p.mesher->stats.projections < 10000; i++) {
        place.latitude = 70 * sin(0.7 * i);
        place.longitude = 37.0 * i;
        const struct camera camera = place_camera(&p, place, 20);
        fixture_picture_draw(&p.picture, p.mesher, &camera);
        assert_true(i < 1000);
    }
    fixture_picture_draw(&p.picture, p.mesher, &first);
    size_t different = 0;
    for (size_t k = 0; k < count; k++) {
        // Heights on the GPU count from other anchors than before: float's last digits.
        different += !(fabsf(before[4 * k + 3] - p.picture.pixels[4 * k + 3]) < 0.5f);
    }
    assert_true(different < count / 1000);
    free(before);
    destroy_planet(&p);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_neighbours_share_their_sides),
        cmocka_unit_test(test_points_of_faces_are_the_same_places),
        cmocka_unit_test(test_viewpoints_are_mapped_back),
        cmocka_unit_test(test_pixels_lie_on_the_ground),
        cmocka_unit_test(test_there_are_no_holes),
        cmocka_unit_test(test_it_draws_what_the_hemisphere_draws),
        cmocka_unit_test(test_neighbours_draw_the_same_border),
        cmocka_unit_test(test_what_is_out_of_view_is_clipped),
        cmocka_unit_test(test_a_descent_shows_no_jump),
        cmocka_unit_test(test_a_camera_that_stays_makes_nothing_new),
        cmocka_unit_test(test_less_error_takes_more_triangles),
        cmocka_unit_test(test_more_squares_than_are_kept_come_and_go),
    };
    return cmocka_run_group_tests(tests, fixture_set_up, fixture_tear_down);
}
