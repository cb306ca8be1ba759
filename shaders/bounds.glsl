// Straight lines above the log ratio L along a segment: where such a line is negative there is no surface.
//
// Along x + s step, 0 <= s <= 1, every h is affine. For gamma >= 1 |h|^gamma is convex: its tangent lies below it, its chord
// above; for gamma < 1, away from h = 0, the other way round. So each T_k has a line above or below it, exact to second order
// in the segment's length. ln sum exp of lines is convex: its chord lies above it, its tangents below.

#include "field.glsl"

// A power at both ends of a segment, and a straight line below or above it between them.
struct Span {
    vec2 ends;
    vec2 line;
};

// Powers, from their logarithms to base 2 at both ends, divided by 2^shift: their values (xy) and lines (zw) each have their own
// where they need one at all. `top` becomes the largest logarithms met.
vec2 powers(vec2 e, vec2 shift)
{
#ifdef HYPERBOLIC
    return exp2(min(e - shift, TOP));
#else
    return exp2(min(e, TOP));
#endif
}

// A lone strip's power where h runs from a to b.
Span strip_span(float a, float b, float gamma, bool below, vec4 shift, inout vec4 top)
{
    vec2 u = abs(vec2(a, b));
    vec2 e = gamma * vec2(log2_of(u.x), log2_of(u.y));
    vec2 v = powers(e, shift.xy);
    bool first = (u.x < u.y) == below;
    float touch = first ? u.x : u.y;
    float away = first ? u.y : u.x;
    float rise = a * b <= 0.0 ? 0.0 : min(gamma * (away - touch) / max(touch, 1e-30), 1e7);
    bool chord = (gamma >= 1.0) != below;
    vec2 from = chord ? e : vec2(first ? e.x : e.y);
    vec2 slope = first ? vec2(1.0, 1.0 + rise) : vec2(1.0 + rise, 1.0);
#ifdef HYPERBOLIC
    vec2 line = powers(from, shift.zw) * (chord ? vec2(1.0) : slope);
    top = max(top, vec4(e, from));
#else
    vec2 line = chord ? v : (first ? v.x : v.y) * slope;
#endif
    if (below && a * b <= 0.0)
        line = vec2(0.0);
    return Span(v, line);
}

#ifdef GROUPS
// A group's sum so far: log2 of its largest |h|, sum of (|h| / largest)^g, and that sum's relative slope.
void add_share(inout vec3 sum, float u, float change, float inner)
{
    float size = log2_of(u);
    float lean = u > 0.0 ? clamp(change / u, -1e6, 1e6) : 0.0;
    float rise = inner * (size - sum.x);
    float scale = exp2(-abs(rise));
    sum = rise > 0.0 ? vec3(size, sum.yz * scale + vec2(1.0, lean)) : vec3(sum.x, sum.yz + scale * vec2(1.0, lean));
}

const vec3 NO_SHARE = vec3(2.0 * ZERO, 0.0, 0.0);

float share_exponent(vec3 sum, Strip strip)
{
    return strip.outer * (sum.x + log2(sum.y) / strip.inner);
}

// The power of the group that begins at `row`.
Span group_span(Strip strip, int row, vec3 x, vec3 step, bool below, vec4 shift, inout vec4 top)
{
    vec3 sum_0 = NO_SHARE;
    vec3 sum_1 = NO_SHARE;
    vec3 sum_bound = NO_SHARE; // with every |h| at its least, or largest
    for (int i = 0; i < int(strip.members); ++i) {
        Strip member = strip_row(row + i);
        float a = strip_function(member, x);
        float b = a + dot(member.normal, step);
        vec2 u = abs(vec2(a, b));
        float rate = b - a;
        add_share(sum_0, u.x, sign(a) * rate, strip.inner);
        add_share(sum_1, u.y, sign(b) * rate, strip.inner);
        add_share(sum_bound, below ? (a * b <= 0.0 ? 0.0 : min(u.x, u.y)) : max(u.x, u.y), 0.0, strip.inner);
    }
    vec2 e = vec2(share_exponent(sum_0, strip), share_exponent(sum_1, strip));
    bool convex = strip.inner >= 1.0 && strip.outer >= 1.0;
    bool first = e.x < e.y;
    float rise = strip.outer * (first ? sum_0.z / sum_0.y : -sum_1.z / sum_1.y);
    bool tangent = convex && below && rise >= -1.0;
    vec2 from = vec2(tangent ? min(e.x, e.y) : share_exponent(sum_bound, strip));
    if (convex && !below)
        from = e;
    top = max(top, vec4(e, from));
    vec2 line = powers(from, shift.zw);
    if (tangent)
        line *= 1.0 + min(rise, 1e7) * (first ? vec2(0.0, 1.0) : vec2(1.0, 0.0));
    return Span(powers(e, shift.xy), line);
}
#endif

// A term's H.
Span scaled_sum_span(Term term, vec3 x, vec3 step, bool below, vec4 shift, out vec4 top)
{
    Span total = Span(vec2(0.0), vec2(0.0));
    top = vec4(0.0);
    int row = int(term.first);
    int end = row + int(term.count);
    while (row < end) {
        Strip strip = strip_row(row);
        bool under = below == (strip.sigma > 0.0);
        float a = strip_function(strip, x);
        Span part = strip_span(a, a + dot(strip.normal, step), strip.outer, under, shift, top);
#ifdef GROUPS
        if (strip.members > 1.0)
            part = group_span(strip, row, x, step, under, shift, top);
#endif
        total.ends += strip.sigma * part.ends;
        total.line += strip.sigma * part.line;
        row += int(strip.members);
    }
    return total;
}

// T, with a line above it for a term that adds, below it for one that carves.
Span term_span(Term term, vec3 x, vec3 step)
{
    vec4 top;
    vec4 shift = vec4(0.0);
    Span sum = scaled_sum_span(term, x, step, term.adds > 0.0, shift, top);
#ifdef HYPERBOLIC
    if (term.hyperbolic != 0.0 && max(max(top.x, top.y), max(top.z, top.w)) > TOP) {
        shift = max(top - TOP, 0.0);
        sum = scaled_sum_span(term, x, step, term.adds > 0.0, shift, top);
    }
#endif
    return Span(
        vec2(term_exponent(term, sum.ends.x, shift.x), term_exponent(term, sum.ends.y, shift.y)),
        vec2(term_exponent(term, sum.line.x, shift.z), term_exponent(term, sum.line.y, shift.w)));
}

#ifdef CARVING
// ln sum exp with its slope.
void add_sloped(inout vec3 sum, float t, float slope)
{
    float rise = t - sum.x;
    float scale = exp(-abs(rise));
    sum = rise > 0.0 ? vec3(t, sum.yz * scale + vec2(1.0, slope)) : vec3(sum.x, sum.yz + scale * vec2(1.0, slope));
}
#endif

// L at x and at x + step, and a line that lies above it between them.
Span look_ahead(vec3 x, vec3 step)
{
    vec2 gain_0 = empty_sum(-1.0);
    vec2 gain_1 = gain_0;
    vec2 above_0 = gain_0;
    vec2 above_1 = gain_0;
    vec2 loss_0 = empty_sum(1.0);
    vec2 loss_1 = loss_0;
    vec3 below_0 = vec3(loss_0, 0.0);
    vec3 below_1 = below_0;
    vec3 least = min(x, x + step);
    vec3 most = max(x, x + step);
    for (int i = 0; i < active_count; ++i) {
        Term term = term_row(active_term(i));
        if (any(lessThan(most, term.low)) || any(greaterThan(least, term.high)))
            continue;
        Span part = term_span(term, x, step);
#ifdef CARVING
        if (term.adds < 0.0) {
            add_exponential(loss_0, part.ends.x);
            add_exponential(loss_1, part.ends.y);
            add_sloped(below_0, part.line.x, part.line.y - part.line.x);
            add_sloped(below_1, part.line.y, part.line.y - part.line.x);
            continue;
        }
#endif
        add_exponential(gain_0, part.ends.x);
        add_exponential(gain_1, part.ends.y);
        add_exponential(above_0, part.line.x);
        add_exponential(above_1, part.line.y);
    }
    vec2 loss = vec2(log_sum(loss_0), log_sum(loss_1));
    vec2 ends = vec2(balance(log_sum(gain_0), loss.x), balance(log_sum(gain_1), loss.y));
    vec2 above = vec2(log_sum(above_0), log_sum(above_1));
#ifdef CARVING
    vec2 below = vec2(log_sum(below_0.xy), log_sum(below_1.xy));
    vec2 from_0 = above - below.x - vec2(0.0, below_0.z / max(below_0.y, 1e-30));
    vec2 from_1 = above - below.y + vec2(below_1.z / max(below_1.y, 1e-30), 0.0);
    return Span(ends, max(from_0.x, from_0.y) < max(from_1.x, from_1.y) ? from_0 : from_1);
#else
    return Span(ends, above - loss);
#endif
}
