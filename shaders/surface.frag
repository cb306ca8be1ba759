#version 330 core
// What each pixel of a tile sees: where, how it faces, its colour and strip. Everything later is worked out from this.

#include "jet.glsl"
#include "march.glsl"
#include "modes.glsl"

const float HATCH = 0.07; // from line to line, about, in the unit frame

uniform sampler2D state;
uniform int region_cut;
#ifdef CURVATURE
const int CURVATURE_COLORS = 7;
uniform vec3 curvature_colors[CURVATURE_COLORS]; // evenly placed on the scale
uniform float curvature_rate;
uniform float curvature_half;
#endif
uniform int ground;       // whether there is one
uniform float ground_z;

layout(location = 0) out vec4 surface_position; // xyz, w: distance from the eye
layout(location = 1) out vec4 surface_normal;   // xyz, w: 0 nothing, 1 the body, 2 the ground, 3 the body's cut
layout(location = 2) out vec4 surface_color;    // linear light, w: the strip's row, -1 for none

// Whether a point lies in the cut.
bool in_cut(vec3 x)
{
    return cut.xyz != vec3(0.0) && abs(dot(cut.xyz, x) - cut.w) < 1e-4;
}

// The face of the region's box that a point on it lies in.
vec3 face_normal(vec3 x)
{
    vec3 middle = 0.5 * (region_low + region_high);
    vec3 from = (x - middle) / (0.5 * (region_high - region_low));
    vec3 a = abs(from);
    vec3 axis = a.x >= max(a.y, a.z) ? vec3(1, 0, 0) : a.y >= a.z ? vec3(0, 1, 0) : vec3(0, 0, 1);
    return axis * sign(from);
}

#ifdef CURVATURE
// From the legend's colours.
vec3 curvature_color(float curvature)
{
    float place = clamp(0.5 + curvature_half * asinh(curvature * curvature_rate), 0.0, 1.0) * float(CURVATURE_COLORS - 1);
    int below = min(int(place), CURVATURE_COLORS - 2);
    return mix(curvature_colors[below], curvature_colors[below + 1], place - float(below));
}
#endif

vec3 body_color(vec3 x, float strip)
{
    if (mode == MODE_STRIPS)
        return strip < 0.0 ? vec3(0.5) : strip_row(int(strip)).tint;
#ifdef CURVATURE
    // a hair aside: at h = 0 itself a second derivative is not had from powers of h
    return curvature_color(gaussian_curvature(x + vec3(1.3e-6, 1.7e-6, 1.1e-6)));
#else
    return mixed_color(x);
#endif
}

// The body's own colour, darker, under thin slanting lines.
vec3 hatched(vec3 color, vec3 x)
{
    vec3 across = abs(cut.z) < 0.9 ? vec3(-cut.y, cut.x, 0.0) : vec3(1.0, 0.0, 0.0);
    across = normalize(across - dot(across, cut.xyz) * cut.xyz);
    float place = dot(x, across + cross(cut.xyz, across)) / HATCH;
    float line = smoothstep(0.34, 0.44, abs(fract(place) - 0.5));
    return mix(0.55 * color + 0.10, 0.25 * color + 0.03, 0.75 * line);
}

void main()
{
    Sight sight = tile_sight();
    float enter;
    Ray ray = enter_region(sight.origin, sight.direction, enter);
    vec4 march = texelFetch(state, ivec2(gl_FragCoord.xy), 0);
    bool hit = march.w == HIT || march.w == INSIDE || march.w == BRACKETED;
    float distance = enter + (march.w == BRACKETED ? march.z : march.x);

    float to_ground = (ground_z - sight.origin.z) / sight.direction.z;
    if (ground != 0 && sight.direction.z < -1e-4 && to_ground > 0.0 && !(hit && distance <= to_ground)) {
        surface_position = vec4(sight.origin.xy + to_ground * sight.direction.xy, ground_z, to_ground);
        surface_normal = vec4(0.0, 0.0, 1.0, 2.0);
        surface_color = vec4(0.0, 0.0, 0.0, -1.0);
        return;
    }
    surface_position = vec4(0.0);
    surface_normal = vec4(0.0);
    surface_color = vec4(0.0, 0.0, 0.0, -1.0);
    if (!hit)
        return;
    vec3 x = ray.origin + (distance - enter) * ray.direction;
#ifdef CELLS
    enter_cell(cell_at(x));
#endif
    Touch touch = touch_at(x);
    vec3 normal = touch.normal;
    bool capped = march.w == INSIDE && enter > 0.0 && (region_cut != 0 || in_cut(x));
    if (capped)
        normal = face_normal(x);
    else if (march.w == INSIDE && enter == 0.0 || normal == vec3(0.0))
        normal = -sight.direction;
    surface_position = vec4(x, distance);
    if (capped && in_cut(x)) {
        surface_normal = vec4(cut.xyz, 3.0);
        surface_color = vec4(hatched(mixed_color(x), x), -1.0);
        return;
    }
    surface_normal = vec4(normal, 1.0);
    surface_color = vec4(body_color(x, capped ? -1.0 : touch.strip), capped ? -1.0 : touch.strip);
}
