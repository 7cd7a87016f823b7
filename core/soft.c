/* soft.c - an area light as several point lights at jittered places that stay where they are from frame to frame
 * (McGuire 2003, section 4; Everitt 2002, section 6).
 *
 * Places are those of a spiral through a ball (a disc for a light at infinity) in even steps of volume, which leaves no
 * gaps and no rows, each moved by a fixed amount that only its number decides. */
#include "gni.h"

#include <math.h>

#define GOLDEN 2.399963229728653 /* radians: the golden angle */

/* 0 to 1, the same for the same number on every machine. */
static double jitter(uint32_t number)
{
    uint32_t x = number * 2654435761u + 0x9e3779b9u;

    x ^= x >> 16;
    x *= 0x85ebca6bu;
    x ^= x >> 13;
    return (double)x / 4294967296.0;
}

gn_result gn_light_soften(gn_context *context, const gn_light *light, double radius, uint32_t count, gn_light *out)
{
    const int is_sun = light && light->kind == GN_LIGHT_DIRECTIONAL;
    double towards[3] = {0, 0, 0}, length;

    if (!context || !light || !out)
        return gn_fail(context, GN_E_ARG, "gn_light_soften: NULL argument");
    if (count == 0)
        return gn_fail(context, GN_E_ARG, "gn_light_soften: 0 lights in place of one");
    if (!(radius >= 0.0 && isfinite(radius)))
        return gn_fail(context, GN_E_ARG, "gn_light_soften: a radius of %g", radius);
    gni_towards(towards, light);
    length = sqrt(gni_dot(towards, towards));
    if (is_sun && !(length > 0.0 && isfinite(length)))
        return gn_fail(context, GN_E_ARG, "gn_light_soften: a light from no direction: %g %g %g", light->towards[0],
                       light->towards[1], light->towards[2]);
    for (uint32_t i = 0; i < count; i++) {
        const double share = (i + 0.5 + 0.5 * (jitter(2 * i) - 0.5)) / count;
        const double height = is_sun ? 0.0 : 1.0 - 2.0 * ((i * 0.6180339887498949) - floor(i * 0.6180339887498949));
        const double turn = GOLDEN * (i + 0.5 * (jitter(2 * i + 1) - 0.5));
        const double away = count == 1 ? 0.0 : radius * (is_sun ? sqrt(share) : cbrt(share)),
                     flat = sqrt(1.0 - height * height);
        const double at[3] = {away * flat * cos(turn), away * height, away * flat * sin(turn)};

        out[i] = *light;
        for (int c = 0; c < 3; c++)
            out[i].color[c] = light->color[c] / count;
        for (int k = 0; k < 3; k++)
            out[i].position[k] += is_sun ? 0.0 : at[k];
        if (is_sun && away > 0.0) { /* across the direction: radius of the disc at distance 1 */
            double axes[3][3];

            gni_make_axes(axes, towards);
            for (int k = 0; k < 3; k++)
                out[i].towards[k] = towards[k] + length * (at[0] * axes[0][k] + at[2] * axes[1][k]);
        }
    }
    return GN_OK;
}
