#version 330 core
// The field at points from a table: F and L.

#include "field.glsl"

uniform sampler2D points;

out vec4 values;

void main()
{
    vec3 x = texelFetch(points, ivec2(gl_FragCoord.xy), 0).xyz;
    values = vec4(field_value(x), log_ratio(x), 0.0, 0.0);
}
