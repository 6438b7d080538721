// Projecting and filtering an environment.
#include "environment.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>
#include <stdexcept>

namespace gll::environment_light {

// excerpt: settings
EnvironmentOptions::EnvironmentOptions(Settings& settings)
    : diffuse(settings.choice("environment_diffuse", "raw", {"raw", "sh9"},
                              "light on matt surfaces: one fetch along the normal, or nine coefficients")),
      specular(
          settings.choice("environment_specular", "raw", {"raw", "prefiltered"},
                          "reflections: one fetch, or mip levels filtered for the surface's roughness")) {
    settings.shared("09_environment_light", {"environment_diffuse", "environment_specular"});
}
// end excerpt

namespace {

constexpr double pi = std::numbers::pi;
constexpr float largest_half_float = 65504;

const std::vector<float>& floatsOf(const Image& image) { return std::get<std::vector<float>>(image.pixels); }

// RGB floats whatever the file has, and nothing that would turn a target infinite.
Image usable(Image image, const std::filesystem::path& path) {
    if (!std::holds_alternative<std::vector<float>>(image.pixels))
        throw std::runtime_error(path.string() + ": an environment must be .hdr or .exr, in linear light");
    if (image.cube_map)
        throw std::runtime_error(path.string() + ": is a cube map (envmap=cube), convert it to latitude and "
                                                 "longitude, one picture twice as wide as high");
    const auto& from = floatsOf(image);
    const auto channels = static_cast<std::size_t>(image.channels);
    std::vector<float> to;
    to.reserve(from.size() / channels * 3);
    for (std::size_t i = 0; i < from.size(); i += channels)
        for (std::size_t c = 0; c < 3; ++c) {
            const float value = from[i + (channels < 3 ? 0 : c)];
            if (std::isnan(value))
                throw std::runtime_error(path.string() + ": holds a value that is not a number");
            to.push_back(std::clamp(value, 0.0F, largest_half_float));
        }
    image.channels = 3;
    image.pixels = std::move(to);
    return image;
}

glm::dvec3 directionOf(double u, double v) {
    const double around = (u - 0.5) * 2 * pi;
    const double down = v * pi;
    return {std::sin(down) * std::cos(around), std::cos(down), std::sin(down) * std::sin(around)};
}

TextureDescription described(const Image& image, int levels) {
    return {.size = {image.width, image.height},
            .format = Format::rgb16f,
            .filter = levels > 1 ? Filter::trilinear : Filter::linear,
            .wrap_x = Wrap::repeat,
            .wrap_y = Wrap::clamp_to_edge,
            .levels = levels};
}

// The image at half of its width and height, each pixel weighing as much as its solid angle.
Image halved(const Image& image) {
    Image half;
    half.width = std::max(image.width / 2, 1);
    half.height = std::max(image.height / 2, 1);
    half.channels = 3;
    std::vector<float> pixels(static_cast<std::size_t>(half.width) * static_cast<std::size_t>(half.height) *
                              3);
    const auto& from = floatsOf(image);
    for (int y = 0; y < half.height; ++y)
        for (int x = 0; x < half.width; ++x) {
            glm::dvec3 sum(0);
            double weights = 0;
            for (int row = y * image.height / half.height; row < (y + 1) * image.height / half.height; ++row)
                for (int column = x * image.width / half.width; column < (x + 1) * image.width / half.width;
                     ++column) {
                    const double weight = std::sin((row + 0.5) / image.height * pi);
                    const std::size_t at = static_cast<std::size_t>(row * image.width + column) * 3;
                    sum += weight * glm::dvec3(from[at], from[at + 1], from[at + 2]);
                    weights += weight;
                }
            for (int c = 0; c < 3; ++c)
                pixels[static_cast<std::size_t>(y * half.width + x) * 3 + static_cast<std::size_t>(c)] =
                    static_cast<float>(sum[c] / weights);
        }
    half.pixels = std::move(pixels);
    return half;
}

// Bilinear, going round in u and stopping at the poles in v.
glm::vec3 lookUp(const Image& image, glm::vec3 direction) {
    constexpr float pi_f = std::numbers::pi_v<float>;
    const float u = std::atan2(direction.z, direction.x) / (2 * pi_f) + 0.5F;
    const float v = std::acos(std::clamp(direction.y, -1.0F, 1.0F)) / pi_f;
    const float x = u * static_cast<float>(image.width) - 0.5F;
    const float y = v * static_cast<float>(image.height) - 0.5F;
    const int x0 = static_cast<int>(std::floor(x));
    const int y0 = static_cast<int>(std::floor(y));
    const auto& pixels = floatsOf(image);
    const auto texel = [&](int column, int row) {
        column = (column + image.width) % image.width;
        row = std::clamp(row, 0, image.height - 1);
        const std::size_t at = static_cast<std::size_t>(row * image.width + column) * 3;
        return glm::vec3(pixels[at], pixels[at + 1], pixels[at + 2]);
    };
    const float fx = x - static_cast<float>(x0);
    const float fy = y - static_cast<float>(y0);
    return glm::mix(glm::mix(texel(x0, y0), texel(x0 + 1, y0), fx),
                    glm::mix(texel(x0, y0 + 1), texel(x0 + 1, y0 + 1), fx), fy);
}

// A direction of the half-vector's distribution in its own frame, how much it counts, and how wide it is.
struct Sample {
    glm::vec3 light; // about z
    float weight;    // cosine at the surface
    std::size_t level;
};

// i-th of count points in the unit square: Hammersley's, evenly spread.
glm::vec2 hammersley(unsigned i, unsigned count) {
    unsigned bits = i;
    bits = (bits << 16U) | (bits >> 16U);
    bits = ((bits & 0x55555555U) << 1U) | ((bits & 0xAAAAAAAAU) >> 1U);
    bits = ((bits & 0x33333333U) << 2U) | ((bits & 0xCCCCCCCCU) >> 2U);
    bits = ((bits & 0x0F0F0F0FU) << 4U) | ((bits & 0xF0F0F0F0U) >> 4U);
    bits = ((bits & 0x00FF00FFU) << 8U) | ((bits & 0xFF00FF00U) >> 8U);
    return {(static_cast<float>(i) + 0.5F) / static_cast<float>(count), static_cast<float>(bits) * 0x1p-32F};
}

} // namespace

std::array<glm::dvec3, 9> irradianceCoefficients(const Image& radiance) {
    const auto& pixels = floatsOf(radiance);
    std::array<glm::dvec3, 9> sums{};
    // Constants of the basis, squared (once to project, once to evaluate), times what the cosine lobe leaves
    // of each band, over pi: 1, 2/3, 1/4.
    constexpr double band0 = 1 / (4 * pi);
    constexpr double band1 = 3 / (4 * pi) * 2 / 3;
    constexpr double band2 = 15 / (4 * pi) / 4;
    constexpr std::array<double, 9> factors = {band0, band1,      band1, band1,    band2,
                                               band2, band2 / 12, band2, band2 / 4};
    for (int row = 0; row < radiance.height; ++row) {
        const double solid_angle =
            (std::cos(row * pi / radiance.height) - std::cos((row + 1) * pi / radiance.height)) * 2 * pi /
            radiance.width;
        for (int column = 0; column < radiance.width; ++column) {
            const glm::dvec3 n = directionOf((column + 0.5) / radiance.width, (row + 0.5) / radiance.height);
            const std::size_t at = static_cast<std::size_t>(row * radiance.width + column) * 3;
            const glm::dvec3 light = solid_angle * glm::dvec3(pixels[at], pixels[at + 1], pixels[at + 2]);
            const std::array<double, 9> basis = {
                1, n.y, n.z, n.x, n.x * n.y, n.y * n.z, 3 * n.z * n.z - 1, n.x * n.z, n.x * n.x - n.y * n.y};
            for (std::size_t i = 0; i < basis.size(); ++i)
                sums[i] += light * basis[i];
        }
    }
    for (std::size_t i = 0; i < sums.size(); ++i)
        sums[i] *= factors[i];
    return sums;
}

std::vector<float> prefilteredLevel(const Image& radiance, int width, int height, float roughness) {
    constexpr unsigned count = 64;
    const float alpha = roughness * roughness;
    // Each sample reads a level whose pixels are as wide as the sample's share of the sphere, so that few
    // suffice (Krivanek and Colbert 2008, "Real-Time Shading with Filtered Importance Sampling").
    std::vector<Image> levels = {radiance};
    while (levels.back().width > 4 && levels.back().height > 2)
        levels.push_back(halved(levels.back()));
    std::vector<Sample> samples;
    const double pixel_solid_angle = 4 * pi / (double(radiance.width) * radiance.height);
    for (unsigned i = 0; i < count; ++i) {
        const glm::vec2 point = hammersley(i, count);
        const float cosine = std::sqrt((1 - point.x) / (1 + (alpha * alpha - 1) * point.x));
        const float sine = std::sqrt(std::max(1 - cosine * cosine, 0.0F));
        const float around = 2 * std::numbers::pi_v<float> * point.y;
        const glm::vec3 half(sine * std::cos(around), sine * std::sin(around), cosine);
        const glm::vec3 light = 2 * half.z * half - glm::vec3(0, 0, 1);
        if (light.z <= 0) continue;
        const double spread = double(cosine) * cosine * (double(alpha) * alpha - 1) + 1;
        const double density = double(alpha) * alpha / (pi * spread * spread) / 4; // of light, view = normal
        const double level = 0.5 * std::log2(1 / (count * density * pixel_solid_angle)) + 1;
        samples.push_back(
            {light, light.z,
             static_cast<std::size_t>(std::clamp(std::round(level), 0.0, double(levels.size() - 1)))});
    }
    std::vector<float> pixels;
    pixels.reserve(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 3);
    for (int row = 0; row < height; ++row)
        for (int column = 0; column < width; ++column) {
            const glm::vec3 normal(directionOf((column + 0.5) / width, (row + 0.5) / height));
            const glm::vec3 up = std::abs(normal.y) < 0.99F ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0);
            const glm::vec3 x_axis = glm::normalize(glm::cross(up, normal));
            const glm::vec3 y_axis = glm::cross(normal, x_axis);
            glm::vec3 sum(0);
            float weights = 0;
            for (const Sample& sample : samples) {
                sum += sample.weight *
                       lookUp(levels[sample.level],
                              sample.light.x * x_axis + sample.light.y * y_axis + sample.light.z * normal);
                weights += sample.weight;
            }
            for (int c = 0; c < 3; ++c)
                pixels.push_back(sum[c] / weights);
        }
    return pixels;
}

Environment::Environment(const std::filesystem::path& path, Warnings& warnings)
    : image_(usable(loadImage(path), path)), map_(described(image_, 1), floatsOf(image_)) {
    warnings.add(image_.warnings);
}

ShaderPart Environment::part(const EnvironmentOptions& options) {
    ShaderPart part{.defines = options.defines(), .inputs = {{"environment_map", map_}}};
    if (options.diffuse == "sh9") part.uniforms.push_back({"irradiance_sh", irradiance()});
    if (options.specular == "prefiltered") {
        part.inputs.push_back({"prefiltered_map", prefiltered()});
        part.uniforms.push_back({"prefiltered_levels", float(last_level)});
    }
    return part;
}

const std::vector<glm::vec3>& Environment::irradiance() {
    if (irradiance_.empty())
        for (const glm::dvec3& coefficient : irradianceCoefficients(image_))
            irradiance_.emplace_back(coefficient);
    return irradiance_;
}

const Texture& Environment::prefiltered() {
    if (!prefiltered_) {
        const int levels = std::min(last_level + 1, levelCount({image_.width, image_.height}));
        prefiltered_.emplace(described(image_, levels), floatsOf(image_));
        for (int level = 1; level < levels; ++level)
            prefiltered_->setLevel(level, prefilteredLevel(image_, std::max(image_.width >> level, 1),
                                                           std::max(image_.height >> level, 1),
                                                           static_cast<float>(level) / last_level));
    }
    return *prefiltered_;
}

} // namespace gll::environment_light
