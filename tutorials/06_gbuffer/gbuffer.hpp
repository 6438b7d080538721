// The G-buffer: what a pass over the scene writes of every visible surface, once, for the passes that light
// it. What it stores and in how many bits are settings.
#pragma once

#include "gl/framebuffer.hpp"
#include "rung/camera.hpp"
#include "rung/frame.hpp"
#include "rung/settings.hpp"

#include <glm/mat4x4.hpp>
#include <string>
#include <vector>

namespace gll::gbuffer {

// From where a frame is seen.
struct View {
    explicit View(const Camera& camera, float aspect)
        : camera_position(camera.position), view_from_world(camera.viewFromWorld()),
          clip_from_view(camera.clipFromView(aspect)) {}

    glm::vec3 camera_position;
    glm::mat4 view_from_world;
    glm::mat4 clip_from_view; // the standard perspective matrix
};

// Where the exponent of a surface's highlight is stored, which no format has a place of its own for.
enum class GlossPlace { normal_alpha, normal_blue, position_alpha, with_specular, target, packed };

struct GBufferOptions {
    // Declares the settings. Every rung but 06 shares them.
    explicit GBufferOptions(Settings& settings);

    Choice packing;
    Choice normals;
    Toggle precise;
    Choice positions;
    Choice gloss;
    Choice albedo;
    Toggle geometric;

    bool storesPosition() const { return positions == "rgba32f" || positions == "rgba16f"; }
    // Where alpha beside the albedo has too few bits for the specular intensity, it has a target of its own.
    bool storesSpecular() const { return packing == "separate" && albedo == "root10"; }
    GlossPlace glossPlace() const;
    // In order of location, depth last: the layout. Nearest, as between two surfaces there is none.
    std::vector<Attachment> attachments() const;
    // Of shaders that write or read the G-buffer.
    Defines defines() const;
};

// The exponents that gloss=palette tells apart: of materials 0 and 1.
inline constexpr glm::vec2 palette_shininess = {48, 24};

class GBuffer {
  public:
    explicit GBuffer(ShaderLibrary& shaders) : shaders_(shaders) {}

    // Pass `pass`: evaluates the material of every visible surface. The parts' defines of the draws are
    // variants of 06_gbuffer/geometry; `material` holds those of all of them: how textures are filtered and
    // the like.
    void draw(Frame& frame, const std::string& pass, const View& view, const std::vector<Draw>& draws,
              const Defines& material, const GBufferOptions& options);

    // For shaders that include 06_gbuffer/read_gbuffer.glsl or read_view.glsl. Valid until the next draw().
    ShaderPart part(const View& view, const GBufferOptions& options) const;

    const Framebuffer& target() const { return target_; }

  private:
    ShaderLibrary& shaders_;
    Framebuffer target_; // see GBufferOptions::attachments()
};

// Each draw with the program that its variant of the stages needs: the files stages + ".vert" and ".frag".
std::vector<Draw> withPrograms(ShaderLibrary& shaders, std::vector<Draw> draws, const std::string& stages,
                               const Defines& defines);

// view z = x / (depth + y), from depth in [0, 1] back through the perspective matrix.
glm::vec2 viewZFromDepth(const glm::mat4& clip_from_view);

} // namespace gll::gbuffer
