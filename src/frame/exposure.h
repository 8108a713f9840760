// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef FRAME_EXPOSURE_H
#define FRAME_EXPOSURE_H
// How bright a picture is shown: fixed, or found from its own radiance. All of it stays on the GPU,
// so that no frame waits for a number; the passes are shaders/frame/meter.frag and adapt.frag.

#include "gpu/program.h"
#include "gpu/target.h"

struct exposure {
    struct gpu *gpu;
    struct gpu_program meter, adapt;
    struct gpu_texture cells; // RG32F: what the meter sees
    struct gpu_target cells_target;
    struct gpu_texture
        values[2]; // RG32F, 1 x 1: EV100 and the factor for luminance; now and before
    struct gpu_target value_targets[2];
    uint32_t now;     // which of the two
    bool has_value;   // false until the first frame
    float wall_cd_m2; // luminance of a white wall that faces the star
};

// What one frame asks for.
struct exposure_request {
    bool is_fixed;
    double ev100;     // when fixed
    double bias_ev;   // stops that the picture is made brighter by
    double elapsed_s; // since the last frame; 0: expose at once for this picture
};

TRL_MUST_USE trl_result exposure_init(struct gpu *gpu, double wall_cd_m2, struct exposure *out);
void exposure_finish(struct exposure *exposure);

// Meters `radiance` (RGBA32F, linear sRGB cd m^-2) unless the request is fixed.
TRL_MUST_USE trl_result exposure_update(struct exposure *exposure,
                                        const struct exposure_request *request,
                                        const struct gpu_texture *radiance);

// The texture (RG32F, 1 x 1) that holds EV100 and the factor; valid until the next update.
const struct gpu_texture *exposure_value(const struct exposure *exposure);

// Reads EV100 back. Waits for the GPU.
TRL_MUST_USE trl_result exposure_read(const struct exposure *exposure, double *ev100);

#endif // FRAME_EXPOSURE_H
