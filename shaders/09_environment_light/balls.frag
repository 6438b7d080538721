#version 330 core
// A ball where the pixel's ray meets it, lit by the environment.
#include "09_environment_light/environment.glsl"

in vec3 world_position;
flat in vec3 middle; // world
flat in float roughness;
flat in vec3 f0;     // reflectance along the normal
flat in vec3 albedo; // of the matt part

uniform vec3 camera_position; // world

out vec4 hdr_color; // linear, [0, infinity)

const float radius = 0.5; // world units, as in balls.hpp

void main() {
    vec3 ray = normalize(world_position - camera_position);
    // from where the ray meets the square: from the camera, squares of 12 units would leave rounding of what is 0.5
    vec3 from_middle = world_position - middle;
    float along = dot(from_middle, ray);
    float inside = along * along - dot(from_middle, from_middle) + radius * radius;
    if (inside < 0.0) discard;
    vec3 normal = (from_middle + ray * (-along - sqrt(inside))) / radius;

    // excerpt: lit
    vec3 irradiance = environmentDiffuse(normal);
#if VIEW == VIEW_IRRADIANCE
    vec3 color = irradiance;
#elif VIEW == VIEW_RADIANCE
    vec3 color = environmentSpecular(reflect(ray, normal), roughness);
#else
    vec3 left;
    vec3 reflected = environmentReflected(normal, -ray, irradiance, reflectanceOf(f0), roughness, left);
    vec3 color = albedo * left * irradiance + reflected;
#endif
    // end excerpt
    hdr_color = vec4(color, 1.0);
}
