// The looks: from a surface and its light to colour, linear and not yet limited to 1.

#include "light.glsl"

const float PI = 3.14159265;
const float ROUGHNESS = 0.55;
const vec3 BACKDROP_LOW = vec3(0.470, 0.462, 0.450);
const vec3 BACKDROP_HIGH = vec3(0.250, 0.262, 0.285);
const float KEY_SHARE = 0.56;
const float SKY_SHARE = 0.58;

// Light that the sky and the floor send to a surface facing along `normal`, in the open.
vec3 open_light(vec3 normal)
{
    return mix(FLOOR_COLOR, SKY_COLOR, smoothstep(-0.9, 1.0, 0.75 * normal.z + 0.1));
}

// Trowbridge-Reitz with Schlick's Fresnel, for the key light's gloss.
float gloss(vec3 normal, vec3 to_eye, vec3 to_light)
{
    vec3 middle = normalize(to_eye + to_light);
    float nh = max(dot(normal, middle), 0.0);
    float nl = max(dot(normal, to_light), 0.0);
    float nv = max(dot(normal, to_eye), 1e-3);
    float a2 = ROUGHNESS * ROUGHNESS * ROUGHNESS * ROUGHNESS;
    float spread = nh * nh * (a2 - 1.0) + 1.0;
    float k = (ROUGHNESS + 1.0) * (ROUGHNESS + 1.0) / 8.0;
    float shade = 1.0 / ((nl * (1.0 - k) + k) * (nv * (1.0 - k) + k));
    float fresnel = 0.04 + 0.96 * pow(1.0 - clamp(dot(middle, to_eye), 0.0, 1.0), 5.0);
    return a2 / (PI * spread * spread) * shade * fresnel * nl * 0.25;
}

// Dry clay: broad soft light, a faint sheen, a rim from behind. `key` is what of the key light arrives, `around` the sky's light.
vec3 clay(vec3 color, vec3 normal, vec3 to_eye, vec3 fill, vec3 rim, float key, vec3 around)
{
    float lit = max(dot(normal, key_direction), 0.0) * key;
    vec3 light = KEY_SHARE * KEY_COLOR * lit + SKY_SHARE * around;
    light += vec3(0.17, 0.19, 0.23) * max(dot(normal, fill), 0.0);
    float edge = pow(1.0 - clamp(dot(normal, to_eye), 0.0, 1.0), 3.0);
    vec3 back = vec3(0.55, 0.60, 0.68) * edge * smoothstep(-0.1, 0.8, dot(normal, rim));
    return color * (light + back * 0.6) + KEY_COLOR * key * gloss(normal, to_eye, key_direction) + back * 0.10;
}

// Behind everything: a floor that runs into a wall without a seam, darker towards the corners.
vec3 backdrop(vec3 direction, vec2 at)
{
    float height = smoothstep(-0.35, 0.45, direction.z);
    vec3 color = mix(BACKDROP_LOW, BACKDROP_HIGH, height);
    return color * (1.05 - 0.38 * smoothstep(0.05, 1.9, dot(at, at)));
}

// From sRGB, for what is shown as it is.
vec3 linear(vec3 c)
{
    return mix(pow((c + 0.055) / 1.055, vec3(2.4)), c / 12.92, lessThanEqual(c, vec3(0.04045)));
}
