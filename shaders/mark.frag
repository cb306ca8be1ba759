#version 330 core
// The picture with what one strip shapes tinted.

uniform sampler2D shown;
uniform sampler2D marks;  // x: 1 + the row of the strip that shapes the surface there
uniform vec2 marks_share; // they fill so much of their texture, from the lower left
uniform ivec3 lit_rows;   // the strip's rows: the first, from one to the next, and how many (a mirrored shape's images have some each)

out vec4 color;

const vec3 TINT = vec3(1.0, 0.70, 0.22);

float is_lit(vec2 pixel)
{
    vec2 last = vec2(textureSize(marks, 0)) * marks_share - 1.0;
    ivec2 at = ivec2(clamp(floor(pixel * marks_share), vec2(0.0), last));
    int after = int(texelFetch(marks, at, 0).x) - 1 - lit_rows.x;
    return after >= 0 && after % lit_rows.y == 0 && after / lit_rows.y < lit_rows.z ? 1.0 : 0.0;
}

void main()
{
    float share = 0.0;
    for (int i = 0; i < 9; ++i)
        share += is_lit(gl_FragCoord.xy + vec2(i % 3, i / 3) - 1.0) / 9.0;
    color = texelFetch(shown, ivec2(gl_FragCoord.xy), 0);
    vec3 lighter = TINT * (0.35 + 0.75 * dot(color.rgb, vec3(0.3, 0.5, 0.2)));
    color.rgb = mix(color.rgb, lighter, 0.55 * share);
}
