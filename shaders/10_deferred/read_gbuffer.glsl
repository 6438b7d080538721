// Reading the G-buffer back: what is there at a place of the screen, whatever layout it has.
#include "10_deferred/gbuffer.glsl"

uniform sampler2D albedo_map;
uniform sampler2D normal_map;
#if STORES_POSITION
uniform sampler2D position_map;
#else
uniform sampler2D depth_map;
uniform vec2 view_z_from_depth; // view z = x / (depth + y)
uniform vec3 camera_position;   // world
uniform mat3 world_from_ray;    // (ndc x, ndc y, 1) to the world vector from the camera to view z = -1
#endif
#if GBUFFER == GBUFFER_COMPACT
uniform vec2 material_shininess; // of mesh and floor
#endif

// excerpt: position_from_depth
#if STORES_POSITION
// xyz: world position; w: 0 where there is nothing, the background
vec4 positionAt(vec2 uv) { return textureLod(position_map, uv, 0.0); }
#else
// Depth says how far along the pixel's ray; the ray is linear over the screen.
float viewZFromDepth(float depth) { return view_z_from_depth.x / (depth + view_z_from_depth.y); }

vec4 positionAt(vec2 uv) {
    float depth = textureLod(depth_map, uv, 0.0).r;
    vec3 ray = world_from_ray * vec3(uv * 2.0 - 1.0, 1.0);
    return vec4(camera_position - viewZFromDepth(depth) * ray, depth < 1.0 ? 1.0 : 0.0);
}
#endif
// end excerpt

vec3 normalAt(vec2 uv) {
#if STORES_OCTAHEDRAL
    return directionFromOctahedral(textureLod(normal_map, uv, 0.0).rg);
#else
    return normalize(textureLod(normal_map, uv, 0.0).rgb);
#endif
}

// Of a place that is not background.
Surface surfaceAt(vec2 uv, vec4 position) {
    vec4 albedo = textureLod(albedo_map, uv, 0.0);
    vec4 normal = textureLod(normal_map, uv, 0.0);
    Surface surface;
    surface.albedo = albedo.rgb;
    surface.specular = albedo.a;
    surface.world_position = position.xyz;
    surface.material = 0.0;
#if STORES_OCTAHEDRAL
    surface.world_normal = directionFromOctahedral(normal.rg);
#else
    surface.world_normal = normalize(normal.rgb);
    surface.shininess = normal.a;
#endif
#if GBUFFER == GBUFFER_OCTAHEDRAL
    surface.shininess = position.a;
#elif GBUFFER == GBUFFER_COMPACT
    vec2 specular_material = unpackSpecular(albedo.a);
    surface.specular = specular_material.x;
    surface.material = specular_material.y;
    surface.shininess = mix(material_shininess.x, material_shininess.y, surface.material);
#endif
    return surface;
}
