// The scene of the deferred rungs: a statue at most 2.2 high on a floor, both modelled in world space, and
// what a rung adds.
#pragma once

#include "gl/pass.hpp"
#include "material.hpp"
#include "rung/rung.hpp"

#include <array>
#include <deque>
#include <optional>
#include <vector>

namespace gll::gbuffer {

enum class Highlights { some, none };

// How the scene's materials are sampled.
struct SceneOptions {
    // Declares the settings. Every rung but 06 shares them; one that draws no highlights has no specular_aa.
    explicit SceneOptions(Settings& settings, Highlights highlights = Highlights::some);

    Choice texture_filter;
    std::optional<Toggle> specular_aa;
    Toggle flip_v;

    MaterialFilter filter() const;
    Defines defines() const {
        return texture_filter.defines() + Defines{{"SPECULAR_AA", specular_aa && *specular_aa ? "1" : "0"}};
    }
};

struct Vertex {
    glm::vec3 position; // world
    glm::vec3 normal;   // unit length
    glm::vec2 uv;       // v = 0 is the top row of an image
};

// What a rung adds to the scene: triangles of one color, without images.
struct PlainObject {
    std::vector<Vertex> vertices;
    std::vector<std::uint32_t> indices;
    glm::vec3 color{1};    // linear albedo
    float specular = 0.5F; // intensity of highlights, [0, 0.6]
    float shininess = 48;  // exponent of highlights
};

class Scene {
  public:
    // The given statue and floor, or the project's cat on brick; the statue is scaled and moved to stand on
    // the floor. Throws std::runtime_error naming the file that cannot be used.
    explicit Scene(const RungResources& resources, float floor_half_width = 6);

    // Nothing but what is added.
    explicit Scene(Warnings& warnings) : warnings_(warnings) {}

    void add(const PlainObject& object);
    void setFloorShininess(float exponent) { surfaces_[floor_surface_].shininess = exponent; }

    // Attributes 0: position, 1: normal, 2: uv, 3: color, 4: second uv; nearest the camera first, so that the
    // depth test spares what is behind. The draws last as long as the scene and until the next call with
    // other options; the defines of a draw's part are the variant of the shaders that it needs.
    std::vector<Draw> materialDraws(const SceneOptions& options);
    // Everything, without materials but for what has holes.
    std::vector<Draw> depthDraws(const SceneOptions& options);

  private:
    struct Surface { // a material and how the original treats it
        MaterialData data;
        float occluded_albedo, specular_scale, shininess, normal_strength, tag;
        std::array<std::optional<MaterialTextures>, 3> textures; // by filter, loaded when first drawn
    };
    struct Part {
        const Mesh* mesh;
        std::size_t surface;
        std::uint32_t first_index, index_count;
    };

    // What the statue's materials have and the rungs do not draw, each once, in lines that begin with
    // `where`.
    std::vector<std::string> notDrawn(const std::string& where) const;
    const MaterialTextures& texturesOf(Surface& surface, MaterialFilter filter);
    Draw drawOf(const Part& part, const SceneOptions& options);

    Warnings& warnings_;
    std::optional<Mesh> statue_;
    std::optional<Mesh> floor_;
    std::deque<Mesh> added_;
    bool statue_has_colors_ = false;
    bool statue_is_sheet_ = false;
    std::vector<Surface> surfaces_;
    std::size_t floor_surface_ = 0;
    std::vector<Part> parts_;
};

} // namespace gll::gbuffer
