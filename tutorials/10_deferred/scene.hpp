// The scene of 10_deferred: a statue at most 2.2 high on a floor of 12 x 12, both modelled in world space.
#pragma once

#include "gl/pass.hpp"
#include "material.hpp"
#include "rung/warnings.hpp"

#include <array>
#include <filesystem>
#include <optional>
#include <vector>

namespace gll {

class Scene {
  public:
    // mesh: .obj, .gltf or .glb, scaled and moved to stand on the floor; floor: .mtl, its first material.
    // Throws std::runtime_error naming the file that cannot be used. The warnings must outlive the scene.
    Scene(const std::filesystem::path& mesh, const std::filesystem::path& floor, Warnings& warnings);

    // What the statue's materials have and the rung does not draw, each once, in lines that begin with
    // `where`.
    std::vector<std::string> notDrawn(const std::string& where) const;

    // Attributes 0: position, 1: normal, 2: uv, 3: color, 4: second uv; nearest the camera first, so that the
    // depth test spares what is behind. The draws last as long as the scene and until the next call with
    // another filter; the defines of a draw's part are the variant of the shaders that it needs. flip_v turns
    // the statue's texture coordinates over.
    std::vector<Draw> materialDraws(MaterialFilter filter, bool flip_v);
    // Everything, without materials but for what has holes.
    std::vector<Draw> depthDraws(MaterialFilter filter, bool flip_v);

  private:
    struct Surface { // a material and how the seed treats it
        MaterialData data;
        float occluded_albedo, specular_scale, shininess, normal_strength, tag;
        std::array<std::optional<MaterialTextures>, 3> textures; // by filter, loaded when first drawn
    };
    struct Part {
        const Mesh* mesh;
        std::size_t surface;
        std::uint32_t first_index, index_count;
    };

    const MaterialTextures& texturesOf(Surface& surface, MaterialFilter filter);
    Draw drawOf(const Part& part, MaterialFilter filter, bool flip_v);

    Warnings& warnings_;
    Mesh statue_;
    Mesh floor_;
    bool statue_has_colors_ = false;
    bool statue_is_sheet_ = false;
    std::vector<Surface> surfaces_;
    std::vector<Part> parts_;
};

inline constexpr glm::vec2 seed_shininess = {48, 24}; // of statue and floor

} // namespace gll
