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
uniform sampler2D shell_position; // surfaces of what is shown as faint shells
uniform sampler2D shell_normal;
uniform int shells;            // whether there are such
uniform int sky_rays;          // whether there are such rays
uniform vec2 target_origin;    // the tile's lower left in the target
uniform int lit;               // whether the mode is a material's
uniform vec2 depth_range;

const vec3 SHELL = vec3(0.16, 0.42, 0.85);

layout(location = 0) out vec4 color;
layout(location = 1) out vec4 guide;  // what resolve.frag smooths along: the normal, its length telling apart
                                      // the ground and the lines of the cut, and the distance
layout(location = 2) out vec4 mark;   // x: 1 + the row of the strip that shapes the first sample's surface

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

// A faint shell over the picture, clearer at its rim, and fainter where the body hides it.
void add_shell(vec3 to_eye, float behind, ivec2 at)
{
    vec4 normal = texelFetch(shell_normal, at, 0);
    if (normal.w == 0.0)
        return;
    float facing = clamp(dot(normal.xyz, to_eye), 0.0, 1.0);
    float share = 0.14 + 0.5 * (1.0 - facing) * (1.0 - facing);
    if (behind > 0.0 && texelFetch(shell_position, at, 0).w > behind)
        share *= 0.35;
    color.rgb = mix(color.rgb, SHELL, share);
    guide.xyz += share * normal.xyz;
}

void shade_surface(Sight sight, vec4 position, vec4 normal, vec3 own, vec2 pixel, ivec2 at)
{
    vec3 to_eye = -sight.direction;
    if (normal.w == 3.0 && mode != MODE_NORMALS && mode != MODE_DEPTH) {
        color.rgb = own;
        return;
    }
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

void main()
{
    ivec2 at = ivec2(gl_FragCoord.xy - target_origin);
    vec2 pixel = vec2(at) + 0.5 + tile_origin;
    vec4 position = texelFetch(surface_position, at, 0);
    vec4 normal = texelFetch(surface_normal, at, 0);
    vec4 own = texelFetch(surface_color, at, 0);
    Sight sight = sight_through(floor(pixel) + jitter);
    color = vec4(behind(sight, pixel), 1.0);
    float length_there = normal.w == 2.0 ? 0.6 : normal.w == 3.0 ? 0.5 + 3.0 * dot(own.rgb, vec3(0.333)) : 1.0;
    guide = vec4(length_there * normal.xyz, position.w);
    mark = vec4(sample_number == 0 && normal.w == 1.0 ? own.w + 1.0 : 0.0, 0.0, 0.0, 0.0);
    if (normal.w != 0.0)
        shade_surface(sight, position, normal, own.rgb, pixel, at);
    if (shells != 0)
        add_shell(-sight.direction, position.w, at);
}
