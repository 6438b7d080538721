// One pass of a frame said in one statement: what is drawn, with which program, inputs and state.
// Nothing is inherited from the pass before and nothing is left for the next.
#pragma once

#include "gl/framebuffer.hpp"
#include "gl/mesh.hpp"
#include "gl/program.hpp"

#include <optional>

namespace gll {

// A sampler uniform and the texture it reads, which must live until the pass is drawn.
struct Input {
    Input(std::string sampler_name, const Texture& read) : sampler(std::move(sampler_name)), texture(&read) {}
    Input(std::string, const Texture&&) = delete;

    std::string sampler;
    const Texture* texture;
};

struct UniformSetting {
    std::string name;
    UniformValue value;
};

// What one technique hands to the shaders of others: the defines that say which variant of it they are to
// include, and whatever any variant of theirs may read of it. A pass takes what its program uses and leaves
// the rest.
struct ShaderPart {
    Defines defines = {};
    std::vector<Input> inputs = {};
    std::vector<UniformSetting> uniforms = {};

    ShaderPart& operator+=(const ShaderPart& other);
};
ShaderPart operator+(ShaderPart one, const ShaderPart& other);

enum class DepthTest { off, less, less_equal }; // on: depth is also written
enum class Cull { none, back, front };
enum class Blend { replace, add }; // add: destination + source (ONE, ONE)

// One draw call of a pass that has several: its mesh (or a piece of it) and what it sets over the pass's own
// program, inputs and uniforms, for itself alone.
struct Draw {
    const Mesh& mesh;
    std::vector<Input> inputs = {};
    std::vector<UniformSetting> uniforms = {};
    ShaderPart part = {};
    std::uint32_t first_index = 0;
    std::uint32_t index_count = 0;    // 0: to the end of the mesh
    const Program* program = nullptr; // null: the pass's
};

// A rectangle of a target, pixels from the lower left.
struct Viewport {
    glm::ivec2 corner{0};
    glm::ivec2 size{1};
};

struct Pass {
    const Program& program;
    std::vector<Input> inputs = {};
    std::vector<UniformSetting> uniforms = {};
    ShaderPart part = {};       // of which the program uses some; its defines are those it was made with
    const Mesh* mesh = nullptr; // null, and no draws: the screen-covering triangle
    int instances = 1;
    std::vector<Draw> draws = {}; // in place of mesh, where a pass draws several
    DepthTest depth_test = DepthTest::off;
    Cull cull = Cull::none;
    Blend blend = Blend::replace;
    bool srgb_encode = false; // sRGB attachments encode what the shader writes
    std::optional<glm::vec2> polygon_offset =
        {};                                    // slope factor and constant units, as glPolygonOffset has them
    std::optional<glm::vec4> clear_color = {}; // every colour attachment, before drawing
    std::optional<float> clear_depth = {};
    std::optional<Viewport> viewport =
        {};                        // drawn to, and no other; the whole target. Clears are of all of it
    bool depth_clamp = false;      // what lies before the near plane or behind the far one is drawn on it
    bool generate_mipmaps = false; // of every mipmapped attachment, from what was drawn; see Texture
};

// Draws the pass into the target. full_screen_triangle serves a pass without a mesh. Throws
// std::invalid_argument where a uniform or sampler of the program is not given, is given twice with another
// type, or is unknown.
void drawPass(const std::string& name, const Framebuffer& target, const Pass& pass,
              const Mesh& full_screen_triangle);

// Bytes the pass must at least move for each pixel of its target, from the declared formats: every attachment
// written once (and read once where it is blended or depth-tested), every input texture read once.
double bytesPerPixel(const Framebuffer& target, const Pass& pass);

} // namespace gll
