#version 330 core
// One ray a fragment through the scene. Drawn again, with what came out before as `state`, until nothing is left to search.
// Which rays: GIVEN_RAYS from a table, CAMERA_RAYS, KEY_RAYS from surfaces towards the key light, SKY_RAYS all round.

#include "march.glsl"
#include "light.glsl"
#include "modes.glsl"

uniform sampler2D state;
uniform int fresh; // whether this is the first draw
uniform int steps;

#ifdef GIVEN_RAYS
uniform sampler2D ray_origins;    // xyz, w: how far the ray goes
uniform sampler2D ray_directions; // xyz
#else
uniform sampler2D surface_position; // xyz, w: distance from the eye
uniform sampler2D surface_normal;   // xyz, w: what it is
#endif

out vec4 march_state;

const float LIFT = 1.5e-3; // how far above a surface its own rays begin

Ray this_ray(ivec2 at)
{
    float enter;
#if defined(GIVEN_RAYS)
    vec4 origin = texelFetch(ray_origins, at, 0);
    return Ray(origin.xyz, texelFetch(ray_directions, at, 0).xyz, origin.w);
#elif defined(CAMERA_RAYS)
    Sight sight = tile_sight();
    return enter_region(sight.origin, sight.direction, enter);
#else
    vec3 position = texelFetch(surface_position, at, 0).xyz;
    vec4 normal = texelFetch(surface_normal, at, 0);
    if (normal.w == 0.0)
        return Ray(position, normal.xyz, -1.0);
    vec2 pixel = gl_FragCoord.xy + tile_origin;
#ifdef KEY_RAYS
    vec3 direction = key_ray(spread(pixel, KEY_SALT));
    if (dot(direction, normal.xyz) <= 0.0)
        return Ray(position, direction, -1.0);
#else
    vec3 to_eye = -sight_through(floor(pixel) + jitter).direction;
    bool mirrors = mode == MODE_METAL && normal.w == 1.0;
    vec3 direction = mirrors ? mirrored_ray(normal.xyz, to_eye, spread(pixel, SKY_SALT)) : sky_ray(normal.xyz, spread(pixel, SKY_SALT));
#endif
    return enter_region(position + LIFT * normal.xyz, direction, enter);
#endif
}

void main()
{
    ivec2 at = ivec2(gl_FragCoord.xy);
    Ray ray = this_ray(at);
    vec4 before = texelFetch(state, at, 0);
    March march = March(before.x, before.y, before.z, before.w);
    if (fresh != 0)
        march = begin_march(ray);
    march_some(ray, steps, march);
    march_state = vec4(march.t, march.dt, march.far, march.phase);
}
