// The studio: a soft key light, the sky and floor around, and how a pixel's samples are spread over them.

uniform vec3 key_direction; // towards it
uniform float key_radius;   // tangent of half the angle that it fills; 0 for a point
uniform int sample_number;

const vec3 KEY_COLOR = vec3(2.55, 2.42, 2.25);
const vec3 SKY_COLOR = vec3(0.80, 0.86, 0.95);
const vec3 FLOOR_COLOR = vec3(0.46, 0.44, 0.42);

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
