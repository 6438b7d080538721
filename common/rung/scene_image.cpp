// Loading the picture as a texture, and the one pass that draws it.
#include "rung/scene_image.hpp"

#include "io/image.hpp"

#include <algorithm>
#include <cstddef>
#include <type_traits>

namespace gll {
namespace {

// Bottom row first, as OpenGL has it.
template <class Value>
std::vector<Value> bottomUp(const std::vector<Value>& pixels, int height) {
    const std::size_t row = pixels.size() / static_cast<std::size_t>(height);
    std::vector<Value> result;
    result.reserve(pixels.size());
    for (int y = height - 1; y >= 0; --y) {
        const auto first = pixels.begin() + static_cast<std::ptrdiff_t>(static_cast<std::size_t>(y) * row);
        result.insert(result.end(), first, first + static_cast<std::ptrdiff_t>(row));
    }
    return result;
}

// A grey image as RGB: every channel of a colour is there for the shader to read.
template <class Value>
std::vector<Value> withColor(const std::vector<Value>& pixels, int channels) {
    if (channels >= 3) return pixels;
    std::vector<Value> result;
    for (std::size_t i = 0; i < pixels.size(); i += static_cast<std::size_t>(channels))
        result.insert(result.end(), 3, pixels[i]);
    return result;
}

Texture loadTexture(const std::filesystem::path& path, Warnings& warnings) {
    const Image image = loadImage(path);
    warnings.add(image.warnings);
    TextureDescription description{.size = {image.width, image.height},
                                   .filter = Filter::trilinear,
                                   .levels = levelCount({image.width, image.height})};
    return std::visit(
        [&]<class Value>(const std::vector<Value>& pixels) {
            constexpr bool is_float = std::is_same_v<Value, float>;
            description.format = is_float ? Format::rgba32f : Format::srgb8_alpha8;
            if (is_float && image.color_space == ColorSpace::srgb)
                throw std::runtime_error(path.string() +
                                         ": 16 bits of sRGB; give 8 bits, or linear light as .exr or .hdr");
            const auto upload = withColor(bottomUp(pixels, image.height), image.channels);
            return Texture(description, std::span(upload));
        },
        image.pixels);
}

} // namespace

SceneImage::SceneImage(const RungResources& resources) : shaders_(resources.shaders) {
    const std::filesystem::path& path = resources.given.image;
    if (!path.empty()) picture_.emplace(loadTexture(path, resources.warnings));
}

void SceneImage::draw(Frame& frame, const std::string& pass, const Framebuffer& target,
                      const std::string& fragment_file, const Defines& defines,
                      const std::vector<UniformSetting>& uniforms) const {
    const glm::vec2 from = picture_->size();
    const glm::vec2 to = target.size();
    const float scale = std::min(from.x / to.x, from.y / to.y); // picture texels to a target pixel
    const bool same_size = picture_->size() == target.size();
    const Program& program =
        shaders_.fullScreen(fragment_file, defines + Defines{{"SAME_SIZE", same_size ? "1" : "0"}});
    frame.pass(pass, target,
               {.program = program,
                .inputs = {{"picture", *picture_}},
                .uniforms = uniforms,
                .part = {.uniforms = {{"uv_scale", to * scale / from}}},
                .clear_depth = target.hasDepth() ? std::optional(1.0F) : std::nullopt});
}

} // namespace gll
