// What is asked of one point of the surface: the direction of L's gradient, the strip that shapes it, the mixed colour, and
// the Gaussian curvature (eq. 26; Goldman 2005, CAGD 22, section 4.1).

#include "field.glsl"

// Whether a term is more than negligible at x, told from its strips alone.
bool matters(Term term, vec3 x)
{
    if (any(lessThan(x, term.low)) || any(greaterThan(x, term.high)))
        return false;
    int end = int(term.first) + int(term.count);
    for (int row = int(term.first); row < end; ++row) {
        Strip strip = strip_row(row);
        if (abs(strip_function(strip, x)) > strip.reach * 1.001)
            return false;
    }
    return true;
}

// A term's part in the slope of F at x: ln (|c| beta exp T) relative to the surface, with its sign apart.
float log_weight(Term term, vec3 x)
{
    return term_value(term, x) + log(max(term.hardness, 1e-30));
}

// log2 of (sum |h|^g)^(1/g) over the group that begins at `row`.
float group_size(Strip lead, int row, vec3 x)
{
#ifdef GROUPS
    if (lead.members > 1.0)
        return group_exponent(lead, row, x) / lead.outer;
#endif
    return log2_of(abs(strip_function(lead, x)));
}

struct Touch {
    vec3 normal; // outwards, of length 1; 0 where there is no slope
    float strip; // the row of the strip with the largest share in the slope; -1 for none
};

// One walk over all strips. With `top` the largest logarithm of a share met so far, shares are summed relative to it.
Touch touch_at(vec3 x)
{
    vec3 slope = vec3(0.0);
    float top = NOTHING;
    float strongest = -1.0;
    for (int i = 0; i < active_count; ++i) {
        Term term = term_row(active_term(i));
        if (!matters(term, x))
            continue;
        float weight = log_weight(term, x) * 1.44269504;
        int row = int(term.first);
        int end = row + int(term.count);
        while (row < end) {
            Strip lead = strip_row(row);
            int members = int(lead.members);
            float size = group_size(lead, row, x);
            for (int i = 0; i < members; ++i) {
                Strip strip = lead;
                if (i > 0)
                    strip = strip_row(row + i);
                float h = strip_function(strip, x);
                float u = log2_of(abs(h));
                // G S^(G/g - 1) |h|^(g - 1), S^(1/g) = 2^size
                float share = weight + log2(lead.outer) + (lead.outer - lead.inner) * size + (lead.inner - 1.0) * u;
                float pull = share + log2(max(length(strip.normal), 1e-30));
                if (h == 0.0 || pull < top - 60.0)
                    continue;
                if (pull > top) {
                    slope *= exp2(max(top - pull, -126.0));
                    top = pull;
                    strongest = float(row + i);
                }
                slope += term.adds * lead.sigma * sign(h) * exp2(pull - top) * normalize(strip.normal);
            }
            row += members;
        }
    }
    float size = length(slope);
    return Touch(size > 0.0 ? slope / size : vec3(0.0), strongest);
}

// The colours of the shapes that add, by their shares.
vec3 mixed_color(vec3 x)
{
    vec3 total = vec3(0.0);
    vec2 sum = vec2(NOTHING, 0.0);
    for (int i = 0; i < active_count; ++i) {
        Term term = term_row(active_term(i));
        if (term.adds < 0.0 || !matters(term, x))
            continue;
        float rise = term_value(term, x) - sum.x;
        float scale = exp(-abs(rise));
        if (rise > 0.0) {
            total = total * scale + term.color;
            sum = vec2(sum.x + rise, sum.y * scale + 1.0);
        } else {
            total += scale * term.color;
            sum.y += scale;
        }
    }
    return total / max(sum.y, 1e-30);
}

#ifdef CURVATURE
// First and second derivatives of one term's H: slope, then the second ones by xx, yy, zz and xy, yz, zx.
struct Bend {
    vec3 slope;
    vec3 straight;
    vec3 mixed;
};

void add_outer(inout Bend bend, vec3 a, float weight)
{
    bend.straight += weight * a * a;
    bend.mixed += weight * a * a.yzx;
}

Bend term_bend(Term term, vec3 x)
{
    Bend bend = Bend(vec3(0.0), vec3(0.0), vec3(0.0));
    int row = int(term.first);
    int end = row + int(term.count);
    while (row < end) {
        Strip lead = strip_row(row);
        int members = int(lead.members);
        float size = group_size(lead, row, x);
        float value = lead.sigma * exp2(min(lead.outer * size, TOP));
        vec3 lean = vec3(0.0);
        for (int i = 0; i < members; ++i) {
            Strip strip = strip_row(row + i);
            float h = strip_function(strip, x);
            if (h == 0.0)
                continue;
            float share = exp2(lead.inner * (log2_of(abs(h)) - size)); // |h|^g / S
            vec3 relative = strip.normal / h;
            lean += share * relative;
            add_outer(bend, relative, value * lead.outer * (lead.inner - 1.0) * share);
        }
        bend.slope += value * lead.outer * lean;
        add_outer(bend, lean, value * lead.outer * (lead.outer - lead.inner));
        row += members;
    }
    return bend;
}

// In the unit frame: divide by the scale's square for the world's.
float gaussian_curvature(vec3 x)
{
    vec3 slope = vec3(0.0);
    Bend total = Bend(vec3(0.0), vec3(0.0), vec3(0.0));
    float top = NOTHING;
    for (int i = 0; i < active_count; ++i)
        top = max(top, term_value(term_row(active_term(i)), x));
    for (int i = 0; i < active_count; ++i) {
        Term term = term_row(active_term(i));
        float weight = term.adds * term.hardness * exp(max(term_value(term, x) - top, -100.0));
        Bend bend = term_bend(term, x);
        slope -= weight * bend.slope;
        total.straight -= weight * bend.straight;
        total.mixed -= weight * bend.mixed;
        add_outer(total, bend.slope, weight * term.hardness);
    }
    float size = length(slope);
    if (!(size > 0.0 && size < 1e30))
        return 0.0;
    vec3 n = slope / size;
    vec3 d = total.straight / size;
    vec3 m = total.mixed / size; // xy, yz, zx
    vec3 adjugate_straight = d.yzx * d.zxy - m.yzx * m.yzx;
    vec3 adjugate_mixed = m.zxy * m.yzx - m * d.zxy;
    float curvature = dot(n * n, adjugate_straight) + 2.0 * dot(n * n.yzx, adjugate_mixed);
    return abs(curvature) < 1e30 ? curvature : 0.0; // far out, where powers overflow
}
#endif
