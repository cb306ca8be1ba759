// The intersection of a ray with the body, and nothing else. No step is guessed: a segment is left behind only where a line above
// L (bounds.glsl) says that it holds no surface, so nothing thicker than SHORTEST is passed by, at any exponent.
//
// A search may be spread over several draws (llvmpipe ends a shader's loops, without a word, at 65,536 turns in all; other
// drivers reset after seconds): between them it is a vec4.

#include "bounds.glsl"
#include "rays.glsl"

// LONE is defined where the body is one elliptic shape, CONVEX where that is convex.
uniform float lone_constant;  // its H at the surface
uniform float least_exponent; // the least of its exponents

const float SEARCHING = 0.0;
const float BRACKETED = 1.0;  // `far` is in the body
const float HIT = 2.0;
const float INSIDE = 3.0;     // the ray began in the body
const float MISS = 4.0;

#ifdef ANY_HIT
const float SHORTEST = 5e-4;  // lengths in the unit frame; light need not be exact
#else
const float SHORTEST = 4e-6;
#endif
const float OVERSTEP = 1e-5;  // past a cell's border, where the next one's list is asked for

struct March {
    float t;     // no surface before this
    float dt;    // the segment to look at next
    float far;   // where the search ends: out of reach, or in the body
    float phase;
};

#ifdef LONE
// The part of the ray x + t direction, low <= t <= high, on which a term matters.
vec2 term_reach(Term term, vec3 x, vec3 direction, float low, float high)
{
    int end = int(term.first) + int(term.count);
    for (int row = int(term.first); row < end; ++row) {
        Strip strip = strip_row(row);
        float rate = dot(strip.normal, direction);
        float slow = max(abs(rate), 1e-20);
        float middle = -strip_function(strip, x) / (rate < 0.0 ? -slow : slow);
        float half_length = strip.reach / slow;
        low = max(low, middle - half_length);
        high = min(high, middle + half_length);
    }
    return vec2(low, high);
}
#endif

March begin_march(Ray ray)
{
    March march = March(0.0, 0.0, ray.far, MISS);
    if (term_count == 0 || !(ray.far >= 0.0))
        return march;
    vec2 span = vec2(0.0, ray.far);
#ifdef LONE
    span = term_reach(term_row(0), ray.origin, ray.direction, 0.0, ray.far);
#endif
    march.t = max(0.0, span.x - SHORTEST); // a step back, lest rounding puts the start into the body
    march.far = span.y;
    march.dt = 0.5 * (march.far - march.t);
    march.phase = march.t <= march.far ? SEARCHING : MISS;
    return march;
}

#ifdef CONVEX
// H of the lone shape, its slope along the ray, and the longest step that one of its groups allows towards the body.
vec3 convex_sum(vec3 x, vec3 direction)
{
    vec3 total = vec3(0.0);
    int row = int(term_row(0).first);
    int end = row + int(term_row(0).count);
    while (row < end) {
        Strip strip = strip_row(row);
        float h = strip_function(strip, x);
        float size = log2_of(abs(h));
        float slope = h == 0.0 ? 0.0 : strip.outer * dot(strip.normal, direction) / h;
#ifdef GROUPS
        if (strip.members > 1.0) {
            vec3 sum = NO_SHARE;
            for (int i = 0; i < int(strip.members); ++i) {
                Strip member = strip_row(row + i);
                float h = strip_function(member, x);
                add_share(sum, abs(h), sign(h) * dot(member.normal, direction), strip.inner);
            }
            size = share_exponent(sum, strip) / strip.outer;
            slope = strip.outer * sum.z / sum.y;
        }
#endif
        float v = exp2(min(strip.outer * size, TOP));
        total.xy += v * vec2(1.0, slope);
#ifdef GROUPS
        if (v > lone_constant && slope < 0.0)
            total.z = max(total.z, strip.outer / slope * (exp2(log2(lone_constant) / strip.outer - size) - 1.0));
#endif
        row += int(strip.members);
    }
    return total;
}

// H^(1 / least exponent) of a lone convex shape is convex and nearly straight: Newton's steps never pass the surface.
void march_on(Ray ray, inout March march)
{
    vec3 sum = convex_sum(ray.origin + march.t * ray.direction, ray.direction);
    if (sum.x <= lone_constant) {
        march.phase = march.t == 0.0 ? INSIDE : HIT;
        return;
    }
    float rest = exp2(log2(lone_constant / sum.x) / least_exponent) - 1.0;
    float step = max(least_exponent * sum.x / sum.y * rest, sum.z);
    march.t += step;
    if (sum.y >= 0.0 || march.t > march.far)
        march.phase = MISS;
    else if (step < 2e-7 * (1.0 + march.t))
        march.phase = HIT;
}
#else
// Squeezed into -1 .. 1, nearly straight near 0: what a false position can be guessed from when L is of any size.
float squeezed(float ratio)
{
    return ratio / (1.0 + abs(ratio));
}

#ifdef CELLS
// Goes on to the next cell that any term matters in; returns where the ray leaves that again.
float next_cells(Ray ray, inout March march)
{
    vec3 forward = step(0.0, ray.direction);
    vec3 slowness = 1.0 / (mix(vec3(-1.0), vec3(1.0), forward) * max(abs(ray.direction), 1e-18));
    float leave = march.t;
    while (march.t < march.far) {
        vec3 x = ray.origin + (march.t + OVERSTEP) * ray.direction;
        ivec3 cell = cell_at(x);
        vec3 way = (cells_low + (vec3(cell) + forward) * cell_size - x) * slowness;
        leave = march.t + OVERSTEP + max(min(way.x, min(way.y, way.z)), 0.0);
        enter_cell(cell);
        if (active_count > 0)
            break;
        march.t = leave;
    }
    return leave;
}
#endif

// One look at the segment ahead: it is left behind as far as the line above L is negative. Once L is seen positive at its end
// the root is between the two and the next look goes a little past where a false position puts it.
void march_on(Ray ray, inout March march)
{
    float end = march.far;
#ifdef CELLS
    end = min(end, next_cells(ray, march));
#endif
    float dt = min(march.dt, end - march.t);
    if (march.t >= march.far) {
        march.phase = march.phase == BRACKETED ? HIT : MISS;
        return;
    }
    Span ahead = look_ahead(ray.origin + march.t * ray.direction, dt * ray.direction);
    if (march.t == 0.0 && ahead.ends.x > 0.0) {
        march.phase = INSIDE;
        return;
    }
    if (max(ahead.line.x, ahead.line.y) < 0.0) {
        march.t += dt;
        march.dt = max(march.dt, 2.0 * dt);
        return;
    }
    bool shortest = dt <= SHORTEST;
    bool enters = ahead.ends.y > 0.0;
    float low = squeezed(min(ahead.ends.x, -1e-9));
    float guess = dt * low / (low - squeezed(ahead.ends.y));
    if (enters) {
        march.far = march.t + dt;
        march.phase = BRACKETED;
#ifdef ANY_HIT
        march.phase = HIT;
        return;
#endif
        if (shortest) {
            march.t += guess;
            march.phase = HIT;
            return;
        }
    }
    float passed = shortest ? dt : ahead.line.x < 0.0 ? 0.999 * dt * ahead.line.x / (ahead.line.x - ahead.line.y) : 0.0;
    float next = ahead.line.x < 0.0 ? 0.6 * (dt - passed) : 0.35 * dt;
    if (enters && guess > passed)
        next = min(next, 1.1 * (guess - passed) + 0.25 * SHORTEST);
    march.t += passed;
    march.dt = shortest ? 2.0 * dt : max(next, 0.99 * SHORTEST);
}
#endif

// At most `steps` more looks.
void march_some(Ray ray, int steps, inout March march)
{
    for (int i = 0; i < steps && march.phase < HIT; ++i)
        march_on(ray, march);
}
