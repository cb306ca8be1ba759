// Which terms to ask: those that matter around a point (CELLS), or all of them.

#include "layout.glsl"

#ifdef CELLS
uniform int cell_rows;     // the first cell's texel
uniform ivec3 cell_counts;
uniform vec3 cell_size;
uniform vec3 cells_low;    // where they begin

int active_first;
int active_count;

ivec3 cell_at(vec3 x)
{
    return clamp(ivec3(floor((x - cells_low) / cell_size)), ivec3(0), cell_counts - 1);
}

void enter_cell(ivec3 cell)
{
    vec4 head = scene_texel(cell_rows + (cell.z * cell_counts.y + cell.y) * cell_counts.x + cell.x);
    active_first = int(head.x);
    active_count = int(head.y);
}

int active_term(int i)
{
    return int(scene_texel(active_first + i).x);
}
#else
#define active_count term_count

int active_term(int i)
{
    return i;
}
#endif
