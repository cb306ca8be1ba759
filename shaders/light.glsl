// The studio: a soft key light, the sky and floor around, what of it shines back, and how a pixel's samples are spread over them.

uniform vec3 key_direction; // towards it
uniform float key_radius;   // tangent of half the angle that it fills; 0 for a point
uniform vec3 fill_direction;
uniform vec3 rim_direction;
uniform int sample_number;

const vec3 KEY_COLOR = vec3(2.55, 2.42, 2.25);
const vec3 SKY_COLOR = vec3(0.80, 0.86, 0.95);
const vec3 FLOOR_COLOR = vec3(0.46, 0.44, 0.42);
const float BRUSHED = 0.16; // how widely metal spreads what it mirrors

vec3 sky(vec3 direction)
{
    return mix(FLOOR_COLOR, SKY_COLOR, smoothstep(-0.4, 0.9, direction.z));
}

// Two numbers in 0 .. 1 a pixel, spread evenly over its samples (Roberts' R2 sequence, shifted at each pixel by a hash).
const float KEY_SALT = 0.17;
const float SKY_SALT = 0.71;

vec2 spread(vec2 pixel, float salt)
{
    vec3 p = fract(vec3(pixel.xyx) * vec3(0.1031, 0.1030, 0.0973) + salt);
    p += dot(p, p.yzx + 33.33);
    vec2 shift = fract((p.xx + p.yz) * p.zy);
    return fract(shift + float(sample_number) * vec2(0.7548776662, 0.5698402910));
}

// Two directions across `axis`.
mat3 frame_about(vec3 axis)
{
    vec3 other = abs(axis.z) < 0.9 ? vec3(0.0, 0.0, 1.0) : vec3(1.0, 0.0, 0.0);
    vec3 across = normalize(cross(other, axis));
    return mat3(across, cross(axis, across), axis);
}

vec2 disk(vec2 u)
{
    float angle = 6.2831853 * u.y;
    return sqrt(u.x) * vec2(cos(angle), sin(angle));
}

vec3 key_ray(vec2 u)
{
    return normalize(frame_about(key_direction) * vec3(key_radius * disk(u), 1.0));
}

// More often near the normal, by the cosine.
vec3 sky_ray(vec3 normal, vec2 u)
{
    vec2 d = disk(u);
    return normalize(frame_about(normal) * vec3(d, sqrt(max(0.0, 1.0 - dot(d, d)))));
}

// About where a brushed surface mirrors what the eye sees, never below it.
vec3 mirrored_ray(vec3 normal, vec3 to_eye, vec2 u)
{
    vec3 back = reflect(-to_eye, normal);
    vec3 direction = normalize(frame_about(back) * vec3(BRUSHED * disk(u), 1.0));
    return direction + max(0.0, 0.02 - dot(direction, normal)) * normal;
}

// How much of a rectangular lamp about `axis` is seen along a direction: soft at its edges.
float lamp(vec3 direction, vec3 axis, vec2 half_size, float soft)
{
    vec3 at = direction * frame_about(axis);
    if (at.z <= 0.0)
        return 0.0;
    vec2 inside = smoothstep(-soft, soft, half_size - abs(at.xy / at.z));
    return inside.x * inside.y;
}

// What is mirrored: walls that darken upwards, a bright ceiling, and the three lamps; `key` is what of the key light is seen.
vec3 room(vec3 direction, float key, float soft)
{
    float up = direction.z;
    vec3 walls = mix(vec3(0.34, 0.35, 0.38), vec3(0.13, 0.14, 0.16), smoothstep(0.0, 0.6, up));
    vec3 color = mix(FLOOR_COLOR * 0.85, walls, smoothstep(-0.12 - soft, 0.04 + soft, up));
    color = mix(color, SKY_COLOR, 0.85 * smoothstep(0.72 - soft, 0.95 + soft, up));
    color += 1.5 * KEY_COLOR * key * lamp(direction, key_direction, vec2(0.50, 0.36), soft);
    color += vec3(1.15, 1.25, 1.40) * lamp(direction, fill_direction, vec2(0.16, 0.75), soft);
    return color + vec3(1.7, 1.8, 1.95) * lamp(direction, rim_direction, vec2(0.45, 0.22), soft);
}
