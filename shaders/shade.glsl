// The materials: from a surface and its light to colour, linear and not yet limited to 1.

#include "light.glsl"

const float PI = 3.14159265;
const float ROUGHNESS = 0.55;
const vec3 BACKDROP_LOW = vec3(0.470, 0.462, 0.450);
const vec3 BACKDROP_HIGH = vec3(0.250, 0.262, 0.285);
const vec3 BRIGHT = vec3(0.86, 0.86, 0.85);
const float KEY_SHARE = 0.56;
const float SKY_SHARE = 0.58;

// What of the light a surface point gets: of the key light, and from all round (for metal from where it mirrors).
struct Light {
    float key;
    vec3 around;
};

// Light that the sky and the floor send to a surface facing along `normal`, in the open.
vec3 open_light(vec3 normal)
{
    return mix(FLOOR_COLOR, SKY_COLOR, smoothstep(-0.9, 1.0, 0.75 * normal.z + 0.1));
}

// Schlick's share of light that is mirrored, from what is mirrored of light that falls straight in.
vec3 fresnel(vec3 straight, float cosine)
{
    return straight + (1.0 - straight) * pow(1.0 - clamp(cosine, 0.0, 1.0), 5.0);
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
    return a2 / (PI * spread * spread) * shade * fresnel(vec3(0.04), dot(middle, to_eye)).x * nl * 0.25;
}

// Dry clay: broad soft light, a faint sheen, a rim from behind.
vec3 clay(vec3 color, vec3 normal, vec3 to_eye, Light light)
{
    vec3 sum = KEY_SHARE * KEY_COLOR * max(dot(normal, key_direction), 0.0) * light.key + SKY_SHARE * light.around;
    sum += vec3(0.17, 0.19, 0.23) * max(dot(normal, fill_direction), 0.0);
    float edge = pow(1.0 - clamp(dot(normal, to_eye), 0.0, 1.0), 3.0);
    vec3 back = vec3(0.55, 0.60, 0.68) * edge * smoothstep(-0.1, 0.8, dot(normal, rim_direction));
    return color * (sum + back * 0.6) + KEY_COLOR * light.key * gloss(normal, to_eye, key_direction) + back * 0.10;
}

// Glazed porcelain: light goes a little way in before it comes back, and a clear coat mirrors the room.
vec3 porcelain(vec3 color, vec3 normal, vec3 to_eye, Light light)
{
    vec3 body = mix(color, vec3(0.90, 0.89, 0.86), 0.05);
    float lit = max((dot(normal, key_direction) + 0.3) / 1.3, 0.0) * mix(0.18, 1.0, light.key);
    vec3 sum = 0.44 * KEY_COLOR * lit + 0.60 * light.around;
    sum += vec3(0.16, 0.18, 0.21) * max(dot(normal, fill_direction), 0.0);
    vec3 coat = fresnel(vec3(0.07), dot(normal, to_eye));
    vec3 mirrored = room(reflect(-to_eye, normal), 1.6 * light.key, 0.02);
    return body * sum * (1.0 - coat) + coat * mirrored;
}

// Brushed metal: all that it shows is mirrored, in its own colour.
vec3 metal(vec3 color, vec3 normal, vec3 to_eye, Light light)
{
    return fresnel(mix(color, vec3(0.9), 0.15), dot(normal, to_eye)) * light.around;
}

// Flat light from everywhere, as in a catalogue: the colour itself, darker only in hollows and a little as it turns away.
vec3 flat_look(vec3 color, vec3 normal, vec3 to_eye, Light light)
{
    float turned = 0.82 + 0.26 * dot(normal, key_direction) + 0.10 * dot(normal, to_eye);
    return color * light.around * turned;
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
