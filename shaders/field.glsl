// The field of Hanson 1988, eqs. 13, 14 and 44, in float32: the formula, once.
//
//   h = normal . x + offset         H = sum sigma (sum |h|^g)^(G/g)         T = ln |c| + beta (C - H)
//   P = ln sum exp T over what adds, N over what carves, ln |level| on its side       L = P - N: positive inside
//
// Powers are worked out as 2^(gamma log2 |h|) and stop at 2^TOP. Where that loses a hyperbolic term's balance the term is
// worked out again, divided by 2^shift.
//
// What a scene lacks need not be compiled: GROUPS is defined where a strip shares a group, HYPERBOLIC where a sigma is
// negative, CARVING where a term carves.

#include "cells.glsl"

uniform float level_sign;  // -1, 0, 1
uniform float level_log;   // ln |level|

const float TOP = 99.0;
const float CEILING = 1e30;
const float NOTHING = -3e38; // ln 0
const float ZERO = -1e4;     // log2 0

float log2_of(float u)
{
    return u > 0.0 ? log2(u) : ZERO;
}

float strip_function(Strip strip, vec3 x)
{
    return dot(strip.normal, x) + strip.offset;
}

// ln sum exp, a number at a time: largest so far and the sum divided by its exp.
void add_exponential(inout vec2 sum, float t)
{
    float rise = t - sum.x;
    sum = rise > 0.0 ? vec2(t, sum.y * exp(-rise) + 1.0) : vec2(sum.x, sum.y + exp(rise));
}

float log_sum(vec2 sum)
{
    return sum.y > 0.0 ? sum.x + log(sum.y) : NOTHING;
}

vec2 empty_sum(float side)
{
    return side * level_sign > 0.0 ? vec2(level_log, 1.0) : vec2(NOTHING, 0.0);
}

float balance(float p, float n)
{
    return p == n ? 0.0 : clamp(p - n, -1e37, 1e37);
}

#ifdef GROUPS
// log2 of the power of the group that begins at `row`, scaled by its largest member.
float group_exponent(Strip strip, int row, vec3 x)
{
    float largest = log2_of(abs(strip_function(strip, x)));
    float sum = 1.0;
    for (int i = 1; i < int(strip.members); ++i) {
        float u = log2_of(abs(strip_function(strip_row(row + i), x)));
        float rise = strip.inner * (u - largest);
        sum = rise > 0.0 ? sum * exp2(-rise) + 1.0 : sum + exp2(rise);
        largest = max(largest, u);
    }
    return strip.outer * (largest + log2(sum) / strip.inner);
}
#endif

// H divided by 2^shift; `top` becomes the largest log2 of a power met.
float scaled_term_sum(Term term, vec3 x, float shift, out float top)
{
    float total = 0.0;
    top = 0.0;
    int row = int(term.first);
    int end = row + int(term.count);
    while (row < end) {
        Strip strip = strip_row(row);
        float e = strip.outer * log2_of(abs(strip_function(strip, x)));
#ifdef GROUPS
        if (strip.members > 1.0)
            e = group_exponent(strip, row, x);
#endif
        total += strip.sigma * exp2(min(e - shift, TOP));
        top = max(top, e);
        row += int(strip.members);
    }
    return total;
}

// From H, divided by 2^shift, to T; what is beyond the ceiling keeps its order, as a logarithm.
float term_exponent(Term term, float sum, float shift)
{
    float t = clamp(term.hardness * (term.constant * exp2(-shift) - sum), -1e38, 1e38);
    if (shift > 0.0 || abs(t) > CEILING) {
        float size = log2(max(abs(t), 1e-37)) + shift;
        t = sign(t) * (size > TOP ? CEILING * (1.0 + size - TOP) : exp2(size));
    }
    return t + term.log_coefficient;
}

float term_value(Term term, vec3 x)
{
    float top;
    float shift = 0.0;
    float sum = scaled_term_sum(term, x, shift, top);
#ifdef HYPERBOLIC
    if (term.hyperbolic != 0.0 && top > TOP) {
        shift = top - TOP;
        sum = scaled_term_sum(term, x, shift, top);
    }
#endif
    return term_exponent(term, sum, shift);
}

// P and N, both logarithms.
vec2 gain_and_loss(vec3 x)
{
    vec2 gain = empty_sum(-1.0);
    vec2 loss = empty_sum(1.0);
    for (int k = 0; k < term_count; ++k) {
        Term term = term_row(k);
        float t = term_value(term, x);
        if (term.adds > 0.0)
            add_exponential(gain, t);
        else
            add_exponential(loss, t);
    }
    return vec2(log_sum(gain), log_sum(loss));
}

float log_ratio(vec3 x)
{
    vec2 sides = gain_and_loss(x);
    return balance(sides.x, sides.y);
}

// F = P - N itself, from L where that keeps more digits.
float field_value(vec3 x)
{
    vec2 sides = gain_and_loss(x);
    float larger = max(sides.x, sides.y);
    float share = 1.0 - exp(-abs(balance(sides.x, sides.y)));
    return sign(sides.x - sides.y) * min(share * exp(min(larger, 80.0)), CEILING);
}
