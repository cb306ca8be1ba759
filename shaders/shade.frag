#version 330 core
// One sample of the picture, added to those before it.

#include "rays.glsl"
#include "modes.glsl"
#include "shade.glsl"

uniform sampler2D surface_position;
uniform sampler2D surface_normal;
uniform sampler2D surface_color;
uniform sampler2D key_state;   // where rays towards the key light ended
uniform sampler2D sky_state;   // and rays all round
uniform int sky_rays;          // whether there are such rays
uniform vec2 target_origin;    // the tile's lower left in the target
uniform int lit;               // whether the mode is a material's
uniform vec2 depth_range;

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
    if (mode == MODE_STUDIO)
        return sky_rays != 0 && meets_body(sky_state, at) ? 0.2 + 0.3 * own : vec3(1.0);
    if (sky_rays == 0)
        return open_light(normal) * 0.82;
    return meets_body(sky_state, at) ? 0.30 * own : sky(sky_ray(normal, spread(pixel, SKY_SALT)));
}

// What metal mirrors: the room, or the body itself.
vec3 light_mirrored(vec3 normal, vec3 to_eye, vec3 own, vec2 pixel, ivec2 at)
{
    if (sky_rays == 0)
        return room(reflect(-to_eye, normal), 1.0, 0.12);
    return meets_body(sky_state, at) ? 0.05 + 0.32 * own : room(mirrored_ray(normal, to_eye, spread(pixel, SKY_SALT)), 1.0, 0.06);
}

// How much darker than in the open the ground is.
vec3 ground_shade(vec3 position, Light light)
{
    if (mode == MODE_STUDIO)
        return light.around;
    vec3 direct = KEY_SHARE * KEY_COLOR * key_direction.z;
    vec3 open = direct + open_light(vec3(0.0, 0.0, 1.0));
    vec3 here = direct * light.key + light.around;
    vec2 beyond = max(abs(position.xy - 0.5 * (region_low + region_high).xy) - 0.5 * (region_high - region_low).xy, 0.0);
    float far = smoothstep(1.5, 6.0, length(beyond));
    return mix(min(here / open, 1.0), vec3(1.0), far);
}

vec3 material(vec3 own, vec3 normal, vec3 to_eye, Light light)
{
    if (mode == MODE_PORCELAIN)
        return porcelain(own, normal, to_eye, light);
    if (mode == MODE_METAL)
        return metal(own, normal, to_eye, light);
    return mode == MODE_STUDIO ? flat_look(own, normal, to_eye, light) : clay(own, normal, to_eye, light);
}

vec3 property_color(vec3 own, vec3 normal, vec3 to_eye, float distance)
{
    if (mode == MODE_NORMALS)
        return linear(0.5 + 0.5 * normal);
    if (mode == MODE_DEPTH) {
        float share = (distance - depth_range.x) / (depth_range.y - depth_range.x);
        return linear(vec3(clamp(1.0 - share, 0.05, 1.0)));
    }
    return own * (0.25 + 0.75 * max(dot(normal, to_eye), 0.0));
}

vec3 behind(Sight sight, vec2 pixel)
{
    if (lit == 0)
        return mode == MODE_DEPTH ? vec3(0.0) : vec3(0.035);
    return mode == MODE_STUDIO ? BRIGHT : backdrop(sight.direction, 2.0 * pixel / picture_size - 1.0);
}

void main()
{
    ivec2 at = ivec2(gl_FragCoord.xy - target_origin);
    vec2 pixel = vec2(at) + 0.5 + tile_origin;
    vec4 position = texelFetch(surface_position, at, 0);
    vec4 normal = texelFetch(surface_normal, at, 0);
    vec3 own = texelFetch(surface_color, at, 0).rgb;
    Sight sight = sight_through(floor(pixel) + jitter);
    vec3 to_eye = -sight.direction;
    color = vec4(behind(sight, pixel), 1.0);
    guide = vec4(normal.xyz * (normal.w == 2.0 ? 0.6 : 1.0), position.w);
    if (normal.w == 0.0)
        return;
    if (lit == 0) {
        color.rgb = property_color(own, normal.xyz, to_eye, position.w);
        return;
    }
    Light light = Light(mode == MODE_STUDIO || !meets_body(key_state, at) ? 1.0 : 0.0, vec3(0.0));
    bool ground = normal.w == 2.0;
    if (mode == MODE_METAL && !ground)
        light.around = light_mirrored(normal.xyz, to_eye, own, pixel, at);
    else
        light.around = light_around(normal.xyz, ground ? vec3(0.5) : own, pixel, at);
    color.rgb = ground ? color.rgb * ground_shade(position.xyz, light) : material(own, normal.xyz, to_eye, light);
}
