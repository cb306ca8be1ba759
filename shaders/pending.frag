#version 330 core
// Leaves a sample only where a search goes on: what an occlusion query counts.

uniform sampler2D state;

out vec4 color;

void main()
{
    if (texelFetch(state, ivec2(gl_FragCoord.xy), 0).w >= 2.0)
        discard;
    color = vec4(1.0);
}
