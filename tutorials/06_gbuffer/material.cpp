// Reading and packing a material's images.
#include "material.hpp"

#include "height_map.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <glm/common.hpp>
#include <stdexcept>
#include <vector>

namespace gll::gbuffer {
namespace {

using Bytes = std::vector<std::uint8_t>;

std::uint8_t byteOf(float value) {
    return static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0F, 1.0F) * 255.0F));
}

// Images decoded once, however many channels of them are asked for.
class ImageCache {
  public:
    explicit ImageCache(Warnings& warnings) : warnings_(warnings) {}

    // 8-bit pixels of the image; null where the source is empty or cannot be read.
    const Image* get(const ImageSource& source) {
        if (source.empty()) return nullptr;
        for (const auto& [known, image] : images_)
            if (known == source) return image.width > 0 ? &image : nullptr;
        Image image;
        try {
            image = loadImage(source);
        } catch (const std::runtime_error& error) {
            warnings_.add({std::string(error.what()) + "; drawn without this texture"});
            images_.emplace_back(source, Image{});
            return nullptr;
        }
        warnings_.add(image.warnings);
        if (const auto* floats = std::get_if<std::vector<float>>(&image.pixels)) {
            Bytes bytes(floats->size());
            std::transform(floats->begin(), floats->end(), bytes.begin(), byteOf);
            image.pixels = std::move(bytes);
        }
        return &images_.emplace_back(source, std::move(image)).second;
    }

    // The image of a material's normals; heights are made into such first.
    ImageSource normals(const MaterialData& material) {
        ImageSource source = material.normal_texture.image;
        if (source.empty() || material.normal_texture != material.height_texture) return source;
        const Image* heights = get(source);
        if (heights == nullptr) return source;
        if (looksLikeNormalMap(*heights)) {
            warnings_.add(
                {source.name + ": is named as a bump map, has a normal map's colors and is drawn as one"});
            return source;
        }
        Image made;
        made.width = heights->width;
        made.height = heights->height;
        made.channels = 3;
        made.pixels = normalsFromHeights(*heights, material.height_texture.channel, material.height_scale);
        source.name += ", as normals"; // another than the heights, which may also be a color
        images_.emplace_back(source, std::move(made));
        return source;
    }

    bool hasAlpha(const ImageSource& source) {
        const Image* image = get(source);
        return image != nullptr && image->channels % 2 == 0;
    }

  private:
    Warnings& warnings_;
    std::deque<std::pair<ImageSource, Image>> images_;
};

glm::ivec2 sizeOf(const Image* image) {
    return image != nullptr ? glm::ivec2(image->width, image->height) : glm::ivec2(1);
}

// Where a texel of the larger size falls between two of the smaller one, along one axis; images repeat.
struct Place {
    int first, second;
    float fraction;
};
Place placeOf(int i, int size, int image_size) {
    const float position =
        (static_cast<float>(i) + 0.5F) * static_cast<float>(image_size) / static_cast<float>(size) - 0.5F;
    const int floor = static_cast<int>(std::floor(position));
    const auto wrapped = [&](int at) { return (at % image_size + image_size) % image_size; };
    return {wrapped(floor), wrapped(floor + 1), position - static_cast<float>(floor)};
}

// Puts one channel of the image into one of the RGBA pixels, through table; enlarges where it must.
void putChannel(Bytes& pixels, glm::ivec2 size, int to, const Image& image, int from, const Bytes& table) {
    const Bytes& bytes = std::get<Bytes>(image.pixels);
    const int channels = image.channels;
    from = channels < 3 ? (from == 3 && channels == 2 ? 1 : 0) : std::min(from, channels - 1);
    const auto index = [&](int x, int y) {
        return static_cast<std::size_t>(y * image.width + x) * static_cast<std::size_t>(channels) +
               static_cast<std::size_t>(from);
    };
    std::uint8_t* out = pixels.data() + to;
    if (sizeOf(&image) == size) {
        const std::uint8_t* in = bytes.data() + from;
        for (std::size_t left = pixels.size() / 4; left > 0; --left, in += channels, out += 4)
            *out = table[*in];
        return;
    }
    for (int y = 0; y < size.y; ++y) {
        const Place row = placeOf(y, size.y, image.height);
        for (int x = 0; x < size.x; ++x, out += 4) {
            const Place column = placeOf(x, size.x, image.width);
            const auto across = [&](int in_row) {
                return std::lerp(static_cast<float>(table[bytes[index(column.first, in_row)]]),
                                 static_cast<float>(table[bytes[index(column.second, in_row)]]),
                                 column.fraction);
            };
            *out = static_cast<std::uint8_t>(
                std::lround(std::lerp(across(row.first), across(row.second), row.fraction)));
        }
    }
}

// What each byte becomes under value * factor + offset.
Bytes table(float factor, float offset) {
    Bytes result(256);
    for (int i = 0; i < 256; ++i)
        result[static_cast<std::size_t>(i)] = byteOf(static_cast<float>(i) / 255 * factor + offset);
    return result;
}

Wrap wrapOf(TextureWrap wrap) {
    switch (wrap) {
    case TextureWrap::mirrored_repeat:
        return Wrap::mirrored_repeat;
    case TextureWrap::clamp_to_edge:
        return Wrap::clamp_to_edge;
    case TextureWrap::repeat:
        break;
    }
    return Wrap::repeat;
}

// Whether both are read between their texels and beyond their edges as images mostly are.
bool plainlySampled(const TextureData& a, const TextureData& b) {
    const auto plain = [](const TextureData& texture) {
        return texture.wrap_u == TextureWrap::repeat && texture.wrap_v == TextureWrap::repeat &&
               !texture.nearest;
    };
    return plain(a) && plain(b);
}

bool placedPlainly(const TextureData& texture) {
    return texture.empty() || (texture.uv_set == 0 && texture.uv_transform == glm::mat3x2(1.0F));
}

Texture upload(const Bytes& pixels, glm::ivec2 size, bool is_color, MaterialFilter filter,
               const TextureData& sampling) {
    const bool mipmapped = filter != MaterialFilter::bilinear;
    return Texture({.size = size,
                    .format = is_color && mipmapped ? Format::srgb8_alpha8 : Format::rgba8,
                    .filter = mipmapped ? Filter::trilinear : Filter::linear,
                    .nearest_magnified = sampling.nearest,
                    .wrap_x = wrapOf(sampling.wrap_u),
                    .wrap_y = wrapOf(sampling.wrap_v),
                    .levels = mipmapped ? levelCount(size) : 1,
                    .anisotropy = filter == MaterialFilter::anisotropic ? 16.0F : 1.0F},
                   pixels);
}

// rgb from one image, alpha from a channel of another; what an absent image stands for is filled in.
Texture packed(ImageCache& cache, const TextureData& color, glm::ivec3 color_default,
               const TextureData& alpha, float alpha_factor, float alpha_offset, bool is_color,
               MaterialFilter filter) {
    const Image* color_image = cache.get(color.image);
    const Image* alpha_image = cache.get(alpha.image);
    const glm::ivec2 size = glm::max(sizeOf(color_image), sizeOf(alpha_image));
    Bytes pixels(static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y) * 4);
    const Bytes same = table(1, 0);
    for (std::size_t i = 0; i < pixels.size() && color_image == nullptr; i += 4)
        for (int c = 0; c < 3; ++c)
            pixels[i + static_cast<std::size_t>(c)] = static_cast<std::uint8_t>(color_default[c]);
    for (int c = 0; c < 3 && color_image != nullptr; ++c)
        putChannel(pixels, size, c, *color_image, c, same);
    for (std::size_t i = 3; i < pixels.size() && alpha_image == nullptr; i += 4)
        pixels[i] = byteOf(alpha_factor + alpha_offset);
    if (alpha_image != nullptr)
        putChannel(pixels, size, 3, *alpha_image, alpha.channel, table(alpha_factor, alpha_offset));
    return upload(pixels, size, is_color, filter, color_image != nullptr ? color : alpha);
}

} // namespace

bool needsSeparateMaps(const MaterialData& m) {
    const auto share = [](const TextureData& a, const TextureData& b) {
        return a.empty() || b.empty() || plainlySampled(a, b);
    };
    return m.alpha_mode == AlphaMode::mask || !placedPlainly(m.base_color_texture) ||
           !placedPlainly(m.occlusion_texture) || !placedPlainly(m.normal_texture) ||
           !placedPlainly(m.roughness_texture) || !share(m.base_color_texture, m.occlusion_texture) ||
           !share(m.normal_texture, m.roughness_texture);
}

MaterialTextures loadMaterial(const MaterialData& material, MaterialFilter filter, Warnings& warnings) {
    ImageCache cache(warnings);
    constexpr glm::ivec3 white(255);
    constexpr glm::ivec3 flat(128, 128, 255);
    const float open = 1 - material.occlusion_strength;
    TextureData normals = material.normal_texture;
    normals.image = cache.normals(material);
    const auto base = [&](const TextureData& alpha, float factor, float offset) {
        return packed(cache, material.base_color_texture, white, alpha, factor, offset, true, filter);
    };
    const auto surface = [&](const TextureData& alpha, float factor) {
        return packed(cache, normals, flat, alpha, factor, 0, false, filter);
    };
    const auto occlusion = [&](const auto& pack) {
        return pack(material.occlusion_texture, material.occlusion_strength, open);
    };
    if (!needsSeparateMaps(material))
        return {.base = occlusion(base), .surface = surface(material.roughness_texture, material.roughness)};
    const auto alone = [&](const TextureData& alpha, float factor, float offset) {
        return packed(cache, {}, white, alpha, factor, offset, false, filter);
    };
    TextureData opacity = material.base_color_texture;
    opacity.channel = 3;
    if (!cache.hasAlpha(opacity.image)) opacity = {};
    return {.base = base(opacity, 1, 0),
            .surface = surface({}, 1),
            .occlusion = occlusion(alone),
            .roughness = alone(material.roughness_texture, material.roughness, 0)};
}

} // namespace gll::gbuffer
