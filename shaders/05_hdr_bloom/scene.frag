#version 330 core
// Adds the rim light, which depends on where a point is seen from, and writes what may be far brighter than 1.

in vec3 world_position;
flat in vec3 world_normal;
flat in vec3 lit_color;
flat in vec3 rim_color;

uniform vec3 camera_position; // world

out vec4 hdr_color; // linear, [0, infinity)

// excerpt: scene_fragment
void main() {
    vec3 to_camera = normalize(camera_position - world_position);
    float edge = 1.0 - max(dot(world_normal, to_camera), 0.0);
    float rim = edge * edge * sqrt(edge); // edge^2.5, cheaper than pow()
    hdr_color = vec4(lit_color + rim_color * rim, 1.0);
}
// end excerpt
