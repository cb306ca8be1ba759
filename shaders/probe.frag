#version 330 core
// The field at points from a table, and all that is told of a surface point.

#include "jet.glsl"

uniform sampler2D points;

layout(location = 0) out vec4 values; // F, L, Gaussian curvature, the shaping strip's row
layout(location = 1) out vec4 facing; // xyz: the outward normal

void main()
{
    vec3 x = texelFetch(points, ivec2(gl_FragCoord.xy), 0).xyz;
    Touch touch = touch_at(x);
    values = vec4(field_value(x), log_ratio(x), gaussian_curvature(x), touch.strip);
    facing = vec4(touch.normal, 0.0);
}
