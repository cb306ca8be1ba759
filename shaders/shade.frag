#version 330 core
// One sample of the picture, added to those before it.

#include "rays.glsl"
#include "shade.glsl"

const int CLAY = 0;
const int NORMALS = 1;
const int DEPTH = 4;

uniform sampler2D surface_position;
uniform sampler2D surface_normal;
uniform sampler2D surface_color;
uniform sampler2D key_state;   // where rays towards the key light ended
uniform sampler2D sky_state;   // and rays all round
uniform int sky_rays;          // whether there are such rays
uniform vec2 target_origin;    // the tile's lower left in the target
uniform int mode;
uniform vec2 depth_range;
uniform vec3 fill_direction;
uniform vec3 rim_direction;

layout(location = 0) out vec4 color;
layout(location = 1) out vec4 guide; // what resolve.frag smooths along: the normal, shorter on the ground, and the distance

bool meets_body(sampler2D state, ivec2 at)
{
    float phase = texelFetch(state, at, 0).w;
    return phase >= 1.0 && phase < 4.0;
}

// Light from all round as the rays found it; what they meet sends back some of it.
vec3 light_around(vec3 normal, vec3 own, vec2 pixel, ivec2 at)
{
    if (sky_rays == 0)
        return open_light(normal) * 0.82;
    return meets_body(sky_state, at) ? 0.30 * own : sky(sky_ray(normal, spread(pixel, SKY_SALT)));
}

// How much darker than in the open the ground is.
vec3 ground_shade(vec3 position, float key, vec3 around)
{
    vec3 direct = KEY_SHARE * KEY_COLOR * key_direction.z;
    vec3 open = direct + open_light(vec3(0.0, 0.0, 1.0));
    vec3 here = direct * key + around;
    vec2 beyond = max(abs(position.xy - 0.5 * (region_low + region_high).xy) - 0.5 * (region_high - region_low).xy, 0.0);
    float far = smoothstep(1.5, 6.0, length(beyond));
    return mix(min(here / open, 1.0), vec3(1.0), far);
}

void main()
{
    ivec2 at = ivec2(gl_FragCoord.xy - target_origin);
    vec2 pixel = vec2(at) + 0.5 + tile_origin;
    vec4 position = texelFetch(surface_position, at, 0);
    vec4 normal = texelFetch(surface_normal, at, 0);
    vec3 own = texelFetch(surface_color, at, 0).rgb;
    Sight sight = sight_through(floor(pixel) + jitter);
    vec2 place = 2.0 * pixel / picture_size - 1.0;
    vec3 behind = mode == CLAY ? backdrop(sight.direction, place) : mode == DEPTH ? vec3(0.0) : vec3(0.035);
    color = vec4(behind, 1.0);
    guide = vec4(normal.xyz * (normal.w == 2.0 ? 0.6 : 1.0), position.w);
    if (normal.w == 0.0)
        return;
    vec3 to_eye = -sight.direction;
    float facing = max(dot(normal.xyz, to_eye), 0.0);
    if (mode == CLAY) {
        float key = meets_body(key_state, at) ? 0.0 : 1.0;
        if (normal.w == 2.0)
            color.rgb = behind * ground_shade(position.xyz, key, light_around(normal.xyz, vec3(0.5), pixel, at));
        else
            color.rgb = clay(own, normal.xyz, to_eye, fill_direction, rim_direction, key, light_around(normal.xyz, own, pixel, at));
    } else if (mode == NORMALS) {
        color.rgb = linear(0.5 + 0.5 * normal.xyz);
    } else if (mode == DEPTH) {
        float share = (position.w - depth_range.x) / (depth_range.y - depth_range.x);
        color.rgb = linear(vec3(clamp(1.0 - share, 0.05, 1.0)));
    } else {
        color.rgb = own * (0.25 + 0.75 * facing);
    }
}
