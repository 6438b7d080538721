#version 330 core
// Lights every pixel once, from what the G-buffer holds of it: a sun with Blinn's highlight, and the sky, as ambient
// light and mirrored. What is behind everything is the sky itself.
#include "06_gbuffer/read_gbuffer.glsl"

in vec2 uv;

#if STORES_POSITION
uniform vec3 camera_position; // world
uniform mat3 world_from_ray;  // see read_gbuffer.glsl
#endif
uniform vec3 to_sun; // world, unit length

out vec4 lit_color; // linear, [0, infinity); alpha 0: sky

const vec3 sun_color = vec3(2.5, 2.2, 1.7);

// The horizon is sharp, so that a mirror shows what its normals are off by.
vec3 skyLight(vec3 direction) {
    const vec3 ground = vec3(0.07, 0.055, 0.045);
    const vec3 horizon = vec3(0.75, 0.72, 0.68);
    const vec3 zenith = vec3(0.12, 0.22, 0.50);
    vec3 sky = mix(horizon, zenith, sqrt(max(direction.y, 0.0)));
    return mix(ground, sky, smoothstep(-0.01, 0.01, direction.y));
}

// excerpt: lighting
vec3 litColor(Surface surface) {
    vec3 to_camera = normalize(camera_position - surface.world_position);
    vec3 normal = surface.world_normal;
    float facing = max(dot(normal, to_sun), 0.0);
    vec3 ambient = mix(vec3(0.10, 0.08, 0.07), vec3(0.30, 0.34, 0.45), normal.y * 0.5 + 0.5);

    // Blinn's highlight, the brighter the narrower: it holds the same light at every exponent
    float highlight = pow(max(dot(normal, normalize(to_sun + to_camera)), 0.0), surface.shininess);
    highlight *= (surface.shininess + 8.0) / 25.13 * facing;
    float grazing = 1.0 - max(dot(normal, to_camera), 0.0);
    float fresnel = 0.3 + 0.7 * (grazing * grazing) * (grazing * grazing);
    // a wide lobe blurs the sky's horizon until nothing is left of it
    float sharp = smoothstep(6.0, 11.0, log2(surface.shininess));
    vec3 mirrored = mix(ambient, skyLight(reflect(-to_camera, normal)), sharp);
    return surface.albedo * (sun_color * facing + ambient) +
           surface.specular * (sun_color * highlight + mirrored * fresnel);
}

void main() {
    vec4 position = positionAt(uv);
    if (position.w == 0.0)
        lit_color = vec4(skyLight(normalize(world_from_ray * vec3(uv * 2.0 - 1.0, 1.0))), 0.0);
    else
        lit_color = vec4(litColor(surfaceAt(uv, position)), 1.0);
}
// end excerpt
