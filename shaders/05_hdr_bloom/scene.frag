#version 330 core
// Adds the rim light, which depends on where a point is seen from, and writes what may be far brighter than 1.

in vec3 to_camera;
flat in float facing;
flat in vec3 lit_color;
flat in float boost;

const vec3 rim_light_color = 0.4 * vec3(0.25, 0.35, 0.55);

out vec4 hdr_color; // linear, [0, infinity)

// excerpt: scene_fragment
void main() {
    float cos_view = facing * inversesqrt(dot(to_camera, to_camera));
    float edge = clamp(1.0 - cos_view, 0.0, 1.0);
    float rim = edge * edge * sqrt(edge); // edge^2.5, cheaper than pow()
    hdr_color = vec4((lit_color + rim_light_color * rim) * boost, 1.0);
}
// end excerpt
