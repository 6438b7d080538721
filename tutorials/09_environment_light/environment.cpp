// What is made of an environment, for each of the settings.
#include "environment.hpp"

#include "brdf_table.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <span>
#include <utility>

namespace gll::environment_light {

// excerpt: settings
EnvironmentOptions::EnvironmentOptions(Settings& settings)
    : diffuse(settings.choice(
          "environment_diffuse", "raw", {"raw", "mip", "sh9", "sh9_windowed", "sh9_sun"},
          "light on matt surfaces: one fetch along the normal; one of a coarse mip level; nine "
          "coefficients; those smoothed until none is negative; those of the sky, and the sun by itself")),
      specular(settings.choice("environment_specular", "raw", {"raw", "prefiltered"},
                               "reflections: one fetch, or mip levels filtered for the surface's roughness")),
      prefilter_samples(settings.integer("prefilter_samples", 64, 16, 1024,
                                         "directions averaged for each texel of the prefiltered map")),
      prefilter_filtered(settings.toggle(
          "prefilter_filtered", true,
          "each of those reads the mip level that is as coarse as they lie apart; off: the finest")),
      sun(settings.toggle(
          "environment_sun", false,
          "the brightest small light is taken out of the prefiltered map, and lit by as a light")),
      layout(settings.choice("environment_layout", "equirectangular",
                             {"equirectangular", "cube", "octahedral"},
                             "how the prefiltered map is stored: by latitude and longitude, as the six sides "
                             "of a cube, or as an octahedron, unfolded")),
      brdf(settings.choice("environment_brdf", "original", {"original", "table", "karis", "lazarov"},
                           "how much is reflected: a tenth, more at grazing angles; GGX from a table; "
                           "fits to such tables")),
      brdf_table_size(settings.choice("brdf_table_size", "32", {"16", "32", "64"},
                                      "side of the table, texels; for environment_brdf=table")),
      energy(settings.choice("environment_energy", "none", {"none", "fdez_aguera", "turquin"},
                             "light reflected more than once within the surface: lost; or given back, "
                             "from all round or with the rest; not for environment_brdf=original")) {
    settings.shared("09_environment_light",
                    {"environment_diffuse", "environment_specular", "prefilter_samples", "prefilter_filtered",
                     "environment_sun", "environment_layout", "environment_brdf", "brdf_table_size",
                     "environment_energy"});
    settings.needs({"prefilter_samples", "prefilter_filtered", "environment_sun", "environment_layout"},
                   {{"environment_specular", {"prefiltered"}}});
    settings.needs({"brdf_table_size"}, {{"environment_brdf", {"table"}}});
    settings.needs({"environment_energy"}, {{"environment_brdf", {"table", "karis", "lazarov"}}});
}
// end excerpt

Defines EnvironmentOptions::defines() const {
    return diffuse.defines() + specular.defines() + layout.defines() + brdf.defines() + energy.defines() +
           Defines{{"ENVIRONMENT_SUN", sun ? "1" : "0"}};
}

namespace {

// Level i of the prefiltered map is for this roughness, so that a shader finds level r (1.7 - 0.7 r) times
// the last at r: levels lie closer where lobes are narrow, as texels double from one to the next.
constexpr int last_level = 5;
double roughnessOf(int level) {
    return (1.7 - std::sqrt(1.7 * 1.7 - 4 * 0.7 * level / last_level)) / (2 * 0.7);
}

std::span<const float> floats(const std::vector<glm::vec3>& pixels) {
    return {&pixels[0].x, pixels.size() * 3};
}

TextureDescription described(glm::ivec2 size, int levels) {
    return {.size = size,
            .format = Format::rgb16f,
            .filter = levels > 1 ? Filter::trilinear : Filter::linear,
            .wrap_x = Wrap::repeat,
            .wrap_y = Wrap::clamp_to_edge,
            .levels = levels};
}

double bytesOf(const TextureDescription& texture) {
    double texels = 0;
    for (int level = 0; level < texture.levels; ++level)
        texels += double(std::max(texture.size.x >> level, 1)) * std::max(texture.size.y >> level, 1);
    return texels * formatInfo(texture.format).bytes * (texture.is_cube ? 6 : 1);
}

// The level of the chain that is as fine as a map of this width, or the finest.
const RadianceMap& levelFor(const std::vector<RadianceMap>& chain, int width) {
    std::size_t level = 0;
    while (level + 1 < chain.size() && chain[level + 1].width >= width)
        ++level;
    return chain[level];
}

std::vector<glm::vec3> resampled(const RadianceMap& map, glm::ivec2 size) {
    std::vector<glm::vec3> pixels;
    pixels.reserve(static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y));
    for (int row = 0; row < size.y; ++row)
        for (int column = 0; column < size.x; ++column)
            pixels.push_back(lookUp(map, (glm::vec2(column, row) + 0.5F) / glm::vec2(size)));
    return pixels;
}

} // namespace

Environment::Environment(RadianceMap map)
    : map_(std::move(map)), picture_(described({map_.width, map_.height}, 1), floats(map_.pixels)) {}

Environment::Environment(const std::filesystem::path& path, Warnings& warnings)
    : Environment([&] {
          const Image image = loadImage(path);
          warnings.add(image.warnings);
          return radianceMap(image, path, warnings);
      }()) {}

const std::vector<RadianceMap>& Environment::chain() {
    if (chain_.empty()) chain_ = mipChain(map_);
    return chain_;
}

const SunAndSky& Environment::parted() {
    if (!parted_) parted_ = withoutSun(map_);
    return *parted_;
}

const Texture& Environment::coarse() {
    if (!coarse_) {
        const RadianceMap& level = levelFor(chain(), 4);
        coarse_.emplace(described({level.width, level.height}, 1), floats(level.pixels));
    }
    return *coarse_;
}

// excerpt: prefilter
const Texture& Environment::prefilteredMap(const EnvironmentOptions& options) {
    const std::string as = options.layout.name() + " " + std::to_string(int(options.prefilter_samples)) +
                           (options.prefilter_filtered ? " filtered" : "") + (options.sun ? " sun" : "");
    if (prefiltered_as_ == as) return *prefiltered_;
    const bool by_itself = options.sun && parted().sun;
    if (by_itself && sky_chain_.empty()) sky_chain_ = mipChain(parted().sky);
    const std::vector<RadianceMap>& source = by_itself ? sky_chain_ : chain();
    const Prefilter prefilter{.samples = options.prefilter_samples,
                              .filtered = options.prefilter_filtered,
                              .has_sun = !options.sun && parted().sun};
    // Level 0 is the map itself, for mirrors. A small one is drawn larger, since texels of the last level
    // must still be small beside the widest lobe; a large one smaller, since lobes would not show it.
    const bool equirectangular = options.layout == "equirectangular";
    const bool cube = options.layout == "cube";
    const auto directions = [&](int side) {
        return cube ? cubeDirections(side) : octahedralDirections(side);
    };
    glm::ivec2 size(std::clamp(map_.width, 512, 2048), std::clamp(map_.height, 256, 1024));
    if (!equirectangular) size = glm::ivec2(int(std::bit_ceil(unsigned(size.y)))) / (cube ? 2 : 1);
    TextureDescription description = described(size, last_level + 1);
    description.is_cube = cube;
    if (!equirectangular) description.wrap_x = Wrap::clamp_to_edge;
    const int needed = size.x * (equirectangular ? 1 : cube ? 4 : 2); // pixels all round
    const RadianceMap& finest = map_.width < 2 * needed ? map_ : levelFor(chain(), needed);
    if (equirectangular) {
        const bool same = finest.width == size.x && finest.height == size.y;
        prefiltered_.emplace(description, floats(same ? finest.pixels : resampled(finest, size)));
    } else {
        std::vector<glm::vec3> pixels;
        for (const glm::vec3& direction : directions(size.x))
            pixels.push_back(lookUp(finest, uvOf(direction)));
        prefiltered_.emplace(description, floats(pixels));
    }
    for (int level = 1; level <= last_level; ++level) {
        const glm::ivec2 smaller(size.x >> level, size.y >> level);
        prefiltered_->setLevel(
            level, floats(equirectangular
                              ? prefiltered(source, smaller, roughnessOf(level), prefilter)
                              : prefiltered(source, directions(smaller.x), roughnessOf(level), prefilter)));
    }
    prefiltered_as_ = as;
    return *prefiltered_;
}
// end excerpt

ShaderPart Environment::diffusePart(const EnvironmentOptions& options) {
    if (options.diffuse == "raw") return {};
    if (options.diffuse == "mip") {
        bytes_ += bytesOf(coarse().description());
        return {.inputs = {{"coarse_map", coarse()}}};
    }
    const bool without_sun = options.diffuse == "sh9_sun";
    std::optional<Irradiance>& irradiance = without_sun ? sky_irradiance_ : irradiance_;
    if (!irradiance) irradiance = irradianceCoefficients(without_sun ? parted().sky : map_);
    if (options.diffuse == "sh9_windowed" && !windowed_) windowed_ = windowed(*irradiance);
    const Irradiance& used = options.diffuse == "sh9_windowed" ? *windowed_ : *irradiance;
    bytes_ += 9 * sizeof(glm::vec3);
    return {.uniforms = {{"irradiance_sh", std::vector<glm::vec3>(used.begin(), used.end())}}};
}

ShaderPart Environment::specularPart(const EnvironmentOptions& options) {
    ShaderPart part;
    if (options.specular == "prefiltered") {
        const Texture& map = prefilteredMap(options);
        bytes_ += bytesOf(map.description());
        part += {.inputs = {{"prefiltered_map", map}},
                 .uniforms = {{"prefiltered_levels", float(last_level)},
                              {"prefiltered_size", float(map.size().x)}}};
    }
    if (options.brdf == "table") {
        const int size = std::stoi(options.brdf_table_size.name());
        if (!brdf_table_ || brdf_table_->size().x != size)
            brdf_table_.emplace(TextureDescription{.size = glm::ivec2(size), .format = Format::rg16f},
                                std::span<const float>(brdfTable(size)));
        bytes_ += bytesOf(brdf_table_->description());
        part += {.inputs = {{"brdf_table", *brdf_table_}}, .uniforms = {{"brdf_table_size", float(size)}}};
    }
    return part;
}

ShaderPart Environment::sunPart() {
    const Sun sun = parted().sun.value_or(Sun());
    bytes_ += 2 * sizeof(glm::vec3) + sizeof(float);
    return {.uniforms = {{"to_brightest", glm::vec3(sun.direction)},
                         {"brightest_irradiance", glm::vec3(sun.irradiance)},
                         {"brightest_spread", static_cast<float>(0.5 * sun.mean_squared_angle)}}};
}

ShaderPart Environment::part(const EnvironmentOptions& options) {
    const bool reads_picture = options.diffuse == "raw" || options.specular == "raw";
    bytes_ = reads_picture ? bytesOf(picture_.description()) : 0;
    ShaderPart part{.defines = options.defines(), .inputs = {{"environment_map", picture_}}};
    part += diffusePart(options);
    part += specularPart(options);
    if (options.diffuse == "sh9_sun" || (options.sun && options.specular == "prefiltered")) part += sunPart();
    return part;
}

} // namespace gll::environment_light
