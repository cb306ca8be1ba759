#version 330 core
// From summed samples to the picture: averaged, its highlights rolled off, encoded as sRGB. DRAFT is defined while there are
// no samples yet, only a draft of them.

uniform sampler2D samples;  // sums, w: how many
uniform sampler2D guides;   // sums of normals and distances
uniform sampler2D draft;
uniform vec2 draft_share;   // it fills so much of its texture, from the lower left
uniform int lit;            // whether it shows light and shadow

out vec4 color;

// Straight up to 0.7, then bending towards 1.
vec3 rolled_off(vec3 c)
{
    vec3 over = max(c - 0.7, 0.0);
    return min(c, 0.7) + 0.3 * over / (over + 0.3);
}

vec3 srgb(vec3 c)
{
    return mix(1.055 * pow(max(c, 1e-6), vec3(1.0 / 2.4)) - 0.055, 12.92 * c, lessThanEqual(c, vec3(0.0031308)));
}

float noise(vec2 pixel)
{
    return fract(52.9829189 * fract(dot(pixel, vec2(0.06711056, 0.00583715))));
}

#ifndef DRAFT
// The mean of the samples hereabouts that face the same way and lie as deep: the grain of few rays goes, edges stay.
vec3 smoothed(ivec2 at)
{
    ivec2 last = textureSize(samples, 0) - 1;
    vec4 own = texelFetch(guides, at, 0) / texelFetch(samples, at, 0).w;
    vec4 total = vec4(0.0);
    for (int i = -2; i <= 2; ++i) {
        for (int j = -2; j <= 2; ++j) {
            ivec2 other = clamp(at + ivec2(i, j), ivec2(0), last);
            vec4 sum = texelFetch(samples, other, 0);
            vec4 apart = texelFetch(guides, other, 0) / max(sum.w, 1.0) - own;
            float depth = apart.w / (0.02 * own.w + 1e-6);
            float weight = exp(-40.0 * dot(apart.xyz, apart.xyz) - depth * depth - 0.15 * float(i * i + j * j));
            total += sum.w < 0.5 ? vec4(0.0) : weight * vec4(sum.rgb / sum.w, 1.0);
        }
    }
    return total.rgb / total.w;
}
#endif

void main()
{
#ifdef DRAFT
    vec2 size = vec2(textureSize(draft, 0));
    vec3 light = texture(draft, min(gl_FragCoord.xy / size * draft_share, draft_share - 0.5 / size)).rgb;
#else
    ivec2 at = ivec2(gl_FragCoord.xy);
    vec4 sum = texelFetch(samples, at, 0);
    vec3 light = lit != 0 ? smoothed(at) : sum.rgb / max(sum.w, 1.0);
#endif
    light = lit != 0 ? rolled_off(light) : min(light, 1.0);
    color = vec4(srgb(light) + (noise(gl_FragCoord.xy) - 0.5) / 255.0, 1.0);
}
