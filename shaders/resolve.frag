#version 330 core
// From summed samples to the picture: averaged, its highlights rolled off, encoded as sRGB.

uniform sampler2D samples;  // sums, w: how many
uniform sampler2D draft;    // shown where there are none, from its lower left part
uniform vec2 draft_share;   // as large as this
uniform int filmic;

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

void main()
{
    vec4 sum = texelFetch(samples, ivec2(gl_FragCoord.xy), 0);
    if (sum.w < 0.5) {
        vec2 size = vec2(textureSize(samples, 0));
        vec2 at = min(gl_FragCoord.xy / size * draft_share, draft_share - 0.5 / size);
        sum = vec4(texture(draft, at).rgb, 1.0);
    }
    vec3 light = sum.rgb / max(sum.w, 1.0);
    light = filmic != 0 ? rolled_off(light) : min(light, 1.0);
    color = vec4(srgb(light) + (noise(gl_FragCoord.xy) - 0.5) / 255.0, 1.0);
}
