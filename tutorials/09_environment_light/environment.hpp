// Light from all round: for matt surfaces, for glossy ones, and how much of it a surface reflects. Everything
// but the picture itself is made when first asked for.
#pragma once

#include "gl/pass.hpp"
#include "radiance_map.hpp"
#include "rung/settings.hpp"
#include "rung/warnings.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace gll::environment_light {

struct EnvironmentOptions {
    // Declares the settings. Every rung but 09 shares them.
    explicit EnvironmentOptions(Settings& settings);

    Choice diffuse;
    Choice specular;
    Integer prefilter_samples;
    Toggle prefilter_filtered;
    Toggle sun;
    Choice layout;
    Choice brdf;
    Choice brdf_table_size;
    Choice energy;

    Defines defines() const;
};

class Environment {
  public:
    explicit Environment(RadianceMap map);
    // From an .hdr or .exr; throws as loadImage() and radianceMap().
    Environment(const std::filesystem::path& path, Warnings& warnings);

    // For shaders that include 09_environment_light/environment.glsl. Valid until the next call.
    ShaderPart part(const EnvironmentOptions& options);

    // Of everything that the last part() named, and the picture itself only where it is read.
    double bytes() const { return bytes_; }

  private:
    const std::vector<RadianceMap>& chain();
    const SunAndSky& parted();
    ShaderPart diffusePart(const EnvironmentOptions& options);
    ShaderPart specularPart(const EnvironmentOptions& options);
    ShaderPart sunPart();
    const Texture& coarse();
    const Texture& prefilteredMap(const EnvironmentOptions& options);

    RadianceMap map_;
    Texture picture_;
    std::vector<RadianceMap> chain_;
    std::vector<RadianceMap> sky_chain_;
    std::optional<SunAndSky> parted_;
    std::optional<Irradiance> irradiance_, sky_irradiance_, windowed_;
    std::optional<Texture> coarse_;
    std::optional<Texture> prefiltered_;
    std::string prefiltered_as_; // by which settings
    std::optional<Texture> brdf_table_;
    double bytes_ = 0;
};

} // namespace gll::environment_light
