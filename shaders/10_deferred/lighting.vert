#version 330 core
// One triangle that covers the screen, made from the vertex number. Of what is the same in every pixel, the long lists are
// handed on from here: a software rasteriser looks a uniform up for each pixel, number by number, and has what is flat
// at hand.
#if ENVIRONMENT
#include "09_environment_light/hand_on.glsl"
#endif

#if POINTS
uniform vec3 point_position[3]; // world
uniform vec3 point_color[3];    // linear
flat out vec3 flat_point_position[3];
flat out vec3 flat_point_color[3];
#endif

out vec2 uv; // [0, 1] over the target, (0, 0) at the bottom left

void main() {
    uv = vec2((gl_VertexID << 1) & 2, gl_VertexID & 2);
    gl_Position = vec4(uv * 2.0 - 1.0, 0.0, 1.0);
#if POINTS
    flat_point_position = point_position;
    flat_point_color = point_color;
#endif
#if ENVIRONMENT
    handOnEnvironment();
#endif
}
