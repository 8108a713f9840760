// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// A renderer in somebody else's context: draws there, and presents in that context's own
// framebuffer.
#include "sphere.h"
#include <terrella/renderer.h>

#include <epoxy/egl.h>
#include <epoxy/gl.h>

enum { WINDOW_WIDTH = 64, WINDOW_HEIGHT = 48, WIDTH = 40, HEIGHT = 24, LEFT = 10, BELOW = 6 };

// What an embedder has: a display, a framebuffer, a context that is current.
struct embedder {
    EGLDisplay display;
    EGLSurface surface;
    EGLContext context;
};

static trl_result open_embedder(struct embedder *e)
{
    static const EGLint config_attributes[] = {EGL_SURFACE_TYPE,
                                               EGL_PBUFFER_BIT,
                                               EGL_RENDERABLE_TYPE,
                                               EGL_OPENGL_BIT,
                                               EGL_RED_SIZE,
                                               8,
                                               EGL_GREEN_SIZE,
                                               8,
                                               EGL_BLUE_SIZE,
                                               8,
                                               EGL_NONE};
    static const EGLint surface_attributes[] = {EGL_WIDTH, WINDOW_WIDTH, EGL_HEIGHT, WINDOW_HEIGHT,
                                                EGL_NONE};
    static const EGLint context_attributes[] = {EGL_CONTEXT_MAJOR_VERSION,
                                                3,
                                                EGL_CONTEXT_MINOR_VERSION,
                                                3,
                                                EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                                EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                                EGL_NONE};
    EGLConfig config;
    EGLint count = 0;
    e->display = eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, NULL);
    if (!eglInitialize(e->display, NULL, NULL) || !eglBindAPI(EGL_OPENGL_API) ||
        !eglChooseConfig(e->display, config_attributes, &config, 1, &count) || count < 1) {
        return TRL_ERROR_UNSUPPORTED;
    }
    e->surface = eglCreatePbufferSurface(e->display, config, surface_attributes);
    e->context = eglCreateContext(e->display, config, EGL_NO_CONTEXT, context_attributes);
    return eglMakeCurrent(e->display, e->surface, e->surface, e->context) ? TRL_OK
                                                                          : TRL_ERROR_UNSUPPORTED;
}

static void close_embedder(const struct embedder *e)
{
    eglMakeCurrent(e->display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    eglDestroyContext(e->display, e->context);
    eglDestroySurface(e->display, e->surface);
    // The display stays: terminating it unloads the driver, whose caches would then count as leaks.
}

static void present_shows_what_read_gives(void **state)
{
    struct fixture *f = *state;
    struct embedder embedder;
    fixture_skip_without_gl(f, open_embedder(&embedder));
    trl_scene *scene = sphere_scene(f);
    trl_renderer_desc desc = trl_renderer_desc_default();
    desc.scene = scene;
    desc.gl = TRL_GL_CURRENT;
    desc.wavelengths = 4;
    trl_renderer *renderer = NULL;
    assert_int_equal(trl_renderer_create(f->ctx, &desc, &renderer), TRL_OK);

    const trl_view view = trl_view_default();
    static uint8_t window[4 * WINDOW_WIDTH * WINDOW_HEIGHT], picture[4 * WIDTH * HEIGHT];
    assert_int_equal(trl_renderer_draw(renderer, &view, WIDTH, HEIGHT, 0), TRL_OK);
    assert_int_equal(trl_renderer_read_rgba8(renderer, picture), TRL_OK);
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    glDisable(GL_SCISSOR_TEST);
    glClearColor(1, 0, 1, 1);
    glClear(GL_COLOR_BUFFER_BIT);
    assert_int_equal(trl_renderer_present(renderer, LEFT, BELOW, WIDTH, HEIGHT), TRL_OK);
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    glReadPixels(0, 0, WINDOW_WIDTH, WINDOW_HEIGHT, GL_RGBA, GL_UNSIGNED_BYTE, window);

    int lit = 0;
    for (size_t y = 0; y < HEIGHT; y++) {
        for (size_t x = 0; x < WIDTH; x++) {
            const uint8_t *got = window + 4 * ((BELOW + y) * WINDOW_WIDTH + LEFT + x);
            const uint8_t *wanted = picture + 4 * ((HEIGHT - 1 - y) * WIDTH + x);
            assert_memory_equal(got, wanted, 3);
            lit += wanted[1] > 100;
        }
    }
    assert_true(lit > 20); // the planet is in the picture
    const uint8_t *corner = window;
    assert_true(corner[0] == 255 && corner[1] == 0 && corner[2] == 255); // and nothing beside it
    fixture_expect_error(f, trl_renderer_present(renderer, 0, 0, 0, 1), TRL_ERROR_INVALID,
                         TRL_LOG_ITEM_ARGUMENT);
    trl_renderer_destroy(&renderer);
    trl_scene_destroy(&scene);
    close_embedder(&embedder);
}

static void without_a_current_context_there_is_no_renderer(void **state)
{
    struct fixture *f = *state;
    trl_scene *scene = sphere_scene(f);
    trl_renderer_desc desc = trl_renderer_desc_default();
    desc.scene = scene;
    desc.gl = TRL_GL_CURRENT;
    trl_renderer *renderer = NULL;
    fixture_expect_error(f, trl_renderer_create(f->ctx, &desc, &renderer), TRL_ERROR_UNSUPPORTED,
                         TRL_LOG_ITEM_GPU_CONTEXT);
    assert_null(renderer);
    trl_scene_destroy(&scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(present_shows_what_read_gives),
        cmocka_unit_test(without_a_current_context_there_is_no_renderer),
    };
    return cmocka_run_group_tests_name("present", tests, fixture_set_up, fixture_tear_down);
}
