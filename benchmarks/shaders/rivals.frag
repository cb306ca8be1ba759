#version 330 core
// The usual ways to find a surface along a ray, on the same field: FIXED steps to the first change of sign, then bisection, or
// sphere tracing by one LIPSCHITZ constant for the whole scene.

#include "field.glsl"
#include "rays.glsl"

uniform sampler2D state;  // x: how far along the ray, y: what the field was there, w: 0 searching, 2 hit, 4 miss
uniform int begin;        // steps taken in earlier draws
uniform int steps;        // steps to take in this one
uniform int all_steps;
uniform float slowest;    // 1 / the steepest slope of the near-linear field
uniform float power;      // its exponent, 1 / the largest gamma
uniform float scale;      // 1 / the largest hardness

out vec4 march_state;

float near_linear(vec3 x)
{
    return 1.0 - pow(max(1.0 - log_ratio(x) * scale, 1e-30), power);
}

float bisected(Ray ray, float low, float high)
{
    for (int i = 0; i < 18; ++i) {
        float middle = 0.5 * (low + high);
        if (log_ratio(ray.origin + middle * ray.direction) > 0.0)
            high = middle;
        else
            low = middle;
    }
    return high;
}

void main()
{
    Sight sight = tile_sight();
    float enter;
    Ray ray = enter_region(sight.origin, sight.direction, enter);
    march_state = begin == 0 ? vec4(0.0, enter, 0.0, ray.far < 0.0 ? 4.0 : 0.0) : texelFetch(state, ivec2(gl_FragCoord.xy), 0);
    for (int i = begin; i < begin + steps && march_state.w == 0.0; ++i) {
#ifdef FIXED
        float next = ray.far * float(i + 1) / float(all_steps);
        if (log_ratio(ray.origin + next * ray.direction) > 0.0)
            march_state = vec4(bisected(ray, march_state.x, next), enter, 0.0, 2.0);
        else
            march_state.x = next;
#else
        float value = near_linear(ray.origin + march_state.x * ray.direction);
        if (value > -2e-5)
            march_state.w = 2.0;
        march_state.x -= value * slowest;
#endif
        if (march_state.x > ray.far || i + 1 == all_steps && march_state.w == 0.0)
            march_state.w = 4.0;
    }
}
