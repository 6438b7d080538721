// Reading the G-buffer back: what is there at a place of the screen, whatever layout it has.
#include "06_gbuffer/gbuffer.glsl"

#if IS_PACKED
uniform sampler2D packed_map;
vec2 gbufferSize() { return vec2(textureSize(packed_map, 0)); }
#else
uniform sampler2D albedo_map;
uniform sampler2D normal_map;
#if STORES_SPECULAR
uniform sampler2D specular_map;
#endif
vec2 gbufferSize() { return vec2(textureSize(normal_map, 0)); }
#endif
#if STORES_GEOMETRIC
uniform sampler2D geometric_map;
#endif
#if STORES_POSITION
uniform sampler2D position_map;
#else
#if STORES_VIEW_Z
uniform sampler2D view_z_map;
#else
uniform sampler2D depth_map;
uniform vec2 view_z_from_depth; // view z = x / (depth + y)
#endif
uniform vec3 camera_position;   // world
uniform mat3 world_from_ray;    // (ndc x, ndc y, 1) to the world vector from the camera to view z = -1
#endif
#if GLOSS_IN == GLOSS_IN_TARGET
uniform sampler2D gloss_map;
#endif
#if GLOSS_IN == GLOSS_WITH_SPECULAR && GLOSS == GLOSS_PALETTE
uniform vec2 material_shininess; // of materials 0 and 1
#endif

// excerpt: position_from_depth
#if STORES_POSITION
// xyz: world position; w: 0 where there is nothing, the background
vec4 positionAt(vec2 uv) { return textureLod(position_map, uv, 0.0); }
#else
// Depth says how far along the pixel's ray; the ray is linear over the screen.
#if STORES_VIEW_Z
float viewZAt(vec2 uv, float background) {
    float view_z = textureLod(view_z_map, uv, 0.0).r;
    return view_z < 0.0 ? view_z : background;
}
#else
float viewZAt(vec2 uv, float background) {
    float depth = textureLod(depth_map, uv, 0.0).r;
    return depth < 1.0 ? view_z_from_depth.x / (depth + view_z_from_depth.y) : background;
}
#endif

vec4 positionAt(vec2 uv) {
    float view_z = viewZAt(uv, 0.0);
    vec3 ray = world_from_ray * vec3(uv * 2.0 - 1.0, 1.0);
    return vec4(camera_position - view_z * ray, view_z < 0.0 ? 1.0 : 0.0);
}
#endif
// end excerpt

// Of steps across and up a surface: towards the camera, as x, y and it are right-handed.
vec3 normalOf(vec3 across, vec3 up) {
    vec3 normal = cross(across, up);
    return normal * inversesqrt(max(dot(normal, normal), 1e-30));
}

// excerpt: geometric_normal
#if STORES_GEOMETRIC
vec3 geometricNormalAt(vec2 uv, vec3 world_position) {
    return directionFromOctahedral(textureLod(geometric_map, uv, 0.0).rg);
}
#else
// The normal of the surface itself, without its normal map, from the positions beside it: in either direction from the
// neighbour that is nearer, which most likely lies on the same surface. As exact as the stored positions are, and wrong
// where a surface is one pixel wide.
vec3 geometricNormalAt(vec2 uv, vec3 world_position) {
    vec2 texel = 1.0 / gbufferSize();
    vec3 left = world_position - positionAt(uv - vec2(texel.x, 0.0)).xyz;
    vec3 right = positionAt(uv + vec2(texel.x, 0.0)).xyz - world_position;
    vec3 below = world_position - positionAt(uv - vec2(0.0, texel.y)).xyz;
    vec3 above = positionAt(uv + vec2(0.0, texel.y)).xyz - world_position;
    // nothing is known beyond the screen's border
    bool by_left = uv.x > 1.0 - texel.x || (uv.x > texel.x && dot(left, left) < dot(right, right));
    bool by_below = uv.y > 1.0 - texel.y || (uv.y > texel.y && dot(below, below) < dot(above, above));
    return normalOf(by_left ? left : right, by_below ? below : above);
}
#endif
// end excerpt

// Of a place that is not background.
#if IS_PACKED
vec3 normalAt(vec2 uv) { return packedNormal(wordsOf(textureLod(packed_map, uv, 0.0))); }
vec3 albedoAt(vec2 uv) { return packedAlbedo(wordsOf(textureLod(packed_map, uv, 0.0))); }

Surface surfaceAt(vec2 uv, vec4 position) {
    uvec2 words = wordsOf(textureLod(packed_map, uv, 0.0));
    Surface surface;
    surface.albedo = packedAlbedo(words);
    surface.specular = packedSpecular(words);
    surface.world_normal = packedNormal(words);
    surface.shininess = packedShininess(words);
    surface.world_position = position.xyz;
    return surface;
}
#else
vec3 normalAt(vec2 uv) { return unpackNormal(textureLod(normal_map, uv, 0.0)); }
// rgb: albedo; a: what holds the specular intensity
vec4 colorsAt(vec2 uv) {
    vec4 stored = textureLod(albedo_map, uv, 0.0);
#if STORES_SPECULAR
    return vec4(stored.rgb * stored.rgb, textureLod(specular_map, uv, 0.0).r);
#else
    return stored;
#endif
}
vec3 albedoAt(vec2 uv) { return colorsAt(uv).rgb; }

Surface surfaceAt(vec2 uv, vec4 position) {
    vec4 colors = colorsAt(uv);
    vec4 normal = textureLod(normal_map, uv, 0.0);
    Surface surface;
    surface.albedo = colors.rgb;
    surface.specular = colors.a;
    surface.world_position = position.xyz;
    surface.world_normal = unpackNormal(normal);
#if GLOSS_IN == GLOSS_IN_NORMAL_ALPHA
    surface.shininess = unpackGloss(normal.a);
#elif GLOSS_IN == GLOSS_IN_NORMAL_BLUE
    surface.shininess = unpackGloss(normal.b);
#elif GLOSS_IN == GLOSS_IN_POSITION_ALPHA
#if GLOSS == GLOSS_FLOAT
    surface.shininess = position.a;
#else
    surface.shininess = unpackGloss(position.a - 1.0);
#endif
#elif GLOSS_IN == GLOSS_IN_TARGET
    surface.shininess = unpackGloss(textureLod(gloss_map, uv, 0.0).r);
#else
    vec2 specular_upper = unpackSpecular(colors.a);
    surface.specular = specular_upper.x;
#if GLOSS == GLOSS_PALETTE
    surface.shininess = mix(material_shininess.x, material_shininess.y, specular_upper.y);
#else
    surface.shininess = unpackGloss(specular_upper.y / 15.0);
#endif
#endif
    return surface;
}
#endif
