// The three assets. Each function bakes one into a folder that exists, printing progress to standard output.
// They throw std::runtime_error if a result fails its own checks or cannot be written.
#pragma once

#include <filesystem>

namespace bake {

/// cat.obj, cat.mtl, cat_albedo.jpg, cat_normal.png, cat_arm.png.
void bakeCat(const std::filesystem::path& folder);

/// brick.mtl, brick_albedo.jpg, brick_normal.png, brick_ao.png, brick_roughness.png.
void bakeBrick(const std::filesystem::path& folder);

/// sky.hdr.
void bakeSky(const std::filesystem::path& folder);

} // namespace bake
