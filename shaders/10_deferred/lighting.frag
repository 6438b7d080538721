#version 330 core
// Lights every pixel once, from what the G-buffer, the shadow map and the occlusion say of it.
#include "06_gbuffer/read_gbuffer.glsl"
#if SUN
#include "07_shadow_map/shadow.glsl"
#endif
#if ENVIRONMENT
#define ENVIRONMENT_HANDED_ON
#include "09_environment_light/environment.glsl"
#endif
#include "08_ssao/read_ssao.glsl"

in vec2 uv;

#if STORES_POSITION
uniform vec3 camera_position; // world
#endif
#if SUN
uniform vec3 to_sun;          // world, unit length
#endif
#if POINTS
flat in vec3 flat_point_position[3]; // world
flat in vec3 flat_point_color[3];    // linear
#endif

out vec4 lit_color; // linear, [0, infinity); alpha 0: background

const vec3 sun_color = vec3(1.25, 1.10, 0.80);
const float point_range = 5.5;    // world units from which on a point light is dark
const float occluded_light = 0.55; // what is left of direct light where nothing of the ambient comes through

// excerpt: blinn
// Lambert plus Blinn's highlight (Blinn 1977), for light of strength 1.
float blinnLight(Surface surface, vec3 to_light, vec3 to_camera) {
    vec3 halfway = normalize(to_light + to_camera);
    float highlight = pow(max(dot(surface.world_normal, halfway), 0.0), surface.shininess);
    return max(dot(surface.world_normal, to_light), 0.0) + highlight * surface.specular;
}
// end excerpt

#if SUN
float visibleSun(Surface surface) {
#if BIAS_BY_GEOMETRY
    vec3 normal = geometricNormalAt(uv, surface.world_position);
#else
    vec3 normal = surface.world_normal;
#endif
    return sunVisible(surface.world_position, normal, to_sun);
}

vec3 sunLight(Surface surface, vec3 to_camera) {
    return sun_color * (blinnLight(surface, to_sun, to_camera) * visibleSun(surface));
}
#endif

#if POINTS
// excerpt: points
vec3 pointLight(Surface surface, vec3 to_camera, vec3 light_position, vec3 light_color) {
    vec3 to_light = light_position - surface.world_position;
    float distance_to_light = max(length(to_light), 1e-4);
    float fades = max(1.0 - distance_to_light / point_range, 0.0);
    return light_color * (fades * fades * blinnLight(surface, to_light / distance_to_light, to_camera));
}

// Written out: software rasterisers look arrays up pixel by pixel where the index is not a constant.
vec3 pointLights(Surface surface, vec3 to_camera) {
    return pointLight(surface, to_camera, flat_point_position[0], flat_point_color[0]) +
           pointLight(surface, to_camera, flat_point_position[1], flat_point_color[1]) +
           pointLight(surface, to_camera, flat_point_position[2], flat_point_color[2]);
}
// end excerpt
#endif

#if ENVIRONMENT
// excerpt: ambient
// A sky above, ground below; two fifths of it comes from the environment map. The map is also mirrored.
vec3 ambientLight(vec3 world_normal) {
    const vec3 ground_color = vec3(0.08, 0.06, 0.05);
    const vec3 sky_color = vec3(0.22, 0.24, 0.36);
    vec3 hemisphere = mix(ground_color, sky_color, world_normal.y * 0.5 + 0.5);
    return mix(hemisphere, environmentDiffuse(world_normal), 0.4);
}

// ambient: as much of it is taken away as is reflected, where environment_energy counts it.
vec3 reflectedLight(Surface surface, vec3 to_camera, inout vec3 ambient) {
    // the roughness whose highlight is as wide as Blinn's (Walter et al. 2007): alpha^2 = 2 / (shininess + 2)
    float roughness = sqrt(sqrt(2.0 / (surface.shininess + 2.0)));
    vec3 left;
    vec3 reflected = environmentReflected(surface.world_normal, to_camera, ambient,
                                          reflectanceOfIntensity(surface.specular), roughness, left);
    ambient *= left;
    return reflected;
}
// end excerpt
#endif

// excerpt: lighting
vec3 litColor(Surface surface, float visibility) {
    vec3 to_camera = normalize(camera_position - surface.world_position);
    vec3 light = vec3(0.0);
// one term alone, for a look at it
#if VIEW == VIEW_SUN && SUN
    return vec3(visibleSun(surface));
#elif VIEW == VIEW_AMBIENT && ENVIRONMENT
    return ambientLight(surface.world_normal) * visibilityOfColor(visibility, surface.albedo);
#elif VIEW == VIEW_REFLECTED && ENVIRONMENT
    vec3 unused = vec3(0.0);
    return reflectedLight(surface, to_camera, unused) * visibility;
#elif VIEW == VIEW_SUN || VIEW == VIEW_AMBIENT || VIEW == VIEW_REFLECTED
    return light;
#endif
#if SUN
    light += sunLight(surface, to_camera);
#endif
#if POINTS
    light += pointLights(surface, to_camera);
#endif
#if OCCLUDED_DIRECT
    light *= mix(occluded_light, 1.0, visibility);
#endif
    vec3 untinted = vec3(0.0);
#if ENVIRONMENT
    vec3 ambient = ambientLight(surface.world_normal);
    vec3 reflected = reflectedLight(surface, to_camera, ambient);
#if ENVIRONMENT_BRDF == ENVIRONMENT_BRDF_ORIGINAL
    // a reflection in the color of the surface, as of metal
    light += ambient * visibilityOfColor(visibility, surface.albedo) + reflected * visibility;
#else
    light += ambient * visibilityOfColor(visibility, surface.albedo);
    untinted = reflected * visibility;
#endif
#endif
    return surface.albedo * light + untinted;
}

void main() {
    vec4 position = positionAt(uv);
    if (position.w == 0.0) discard; // the background stays as it was cleared
    lit_color = vec4(litColor(surfaceAt(uv, position), visibilityAt(uv, position.xyz)), 1.0);
}
// end excerpt
