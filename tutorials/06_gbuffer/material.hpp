// A surface's images as the geometry pass reads them: packed into two textures, so that it fetches twice,
// unless they are read at different places or a mask needs the alpha.
#pragma once

#include "gl/texture.hpp"
#include "io/mesh.hpp"
#include "rung/warnings.hpp"

#include <glm/vec3.hpp>

namespace gll::gbuffer {

enum class MaterialFilter { bilinear, mipmapped, anisotropic };

struct MaterialTextures {
    Texture base;    // rgb: albedo as the image has it, sRGB; decoded by the texture unit unless bilinear.
                     // a: occlusion, 1 is open; where maps are separate opacity
    Texture surface; // rgb: tangent-space normal * 0.5 + 0.5, green up the image. a: roughness
    // where maps are separate
    Texture occlusion = {}; // a
    Texture roughness = {}; // a
};

// Whether a material's images cannot be packed: it has a mask; an image is read from the second texture
// coordinates or through a transform; two that would share a texture are read differently beyond their edges
// or between their texels.
bool needsSeparateMaps(const MaterialData& material);

// Reads the images of a material and packs them; one that is smaller than its texture is enlarged
// bilinearly. Row 0 of an image is at v = 0. An image that cannot be read is named in a warning, and the
// material is made without it. A normal texture that is the height texture holds heights, unless its colors
// are those of normals, which is then said.
MaterialTextures loadMaterial(const MaterialData& material, MaterialFilter filter, Warnings& warnings);

} // namespace gll::gbuffer
