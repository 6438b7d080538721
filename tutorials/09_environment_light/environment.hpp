// Light from an equirectangular picture: as it is, as irradiance in nine coefficients, and prefiltered for
// glossy reflection. Everything but the picture itself is made when first asked for.
#pragma once

#include "gl/pass.hpp"
#include "io/image.hpp"
#include "rung/settings.hpp"
#include "rung/warnings.hpp"

#include <array>
#include <filesystem>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

namespace gll::environment_light {

struct EnvironmentOptions {
    // Declares the settings. Every rung but 09 shares them.
    explicit EnvironmentOptions(Settings& settings);

    Choice diffuse;
    Choice specular;

    Defines defines() const { return diffuse.defines() + specular.defines(); }
};

// Irradiance over pi, so that a white matt surface shows it as its radiance, as a polynomial of the normal
// n = (x, y, z), in the order 1, y, z, x, xy, yz, 3z^2 - 1, xz, x^2 - y^2: the spherical harmonics of order 2
// with their constants multiplied in (Ramamoorthi and Hanrahan 2001, "An Efficient Representation for
// Irradiance Environment Maps"). radiance: linear, equirectangular, u round the y axis from -x over -z, v
// from +y down, three floats a pixel. Integrated in double over each pixel's true solid angle.
std::array<glm::dvec3, 9> irradianceCoefficients(const Image& radiance);

// One level of a map prefiltered for GGX of this roughness (alpha = roughness^2), seen along the normal:
// Karis 2013, "Real Shading in Unreal Engine 4". Three floats a pixel, row 0 at the top.
std::vector<float> prefilteredLevel(const Image& radiance, int width, int height, float roughness);

class Environment {
  public:
    Environment(const std::filesystem::path& path, Warnings& warnings);

    // For shaders that include 09_environment_light/environment.glsl. Valid until the next call.
    ShaderPart part(const EnvironmentOptions& options);

  private:
    static constexpr int last_level = 5; // of the prefiltered map: level i holds roughness i / last_level

    const std::vector<glm::vec3>& irradiance();
    const Texture& prefiltered();

    Image image_; // RGB float, finite
    Texture map_;
    std::vector<glm::vec3> irradiance_;
    std::optional<Texture> prefiltered_;
};

} // namespace gll::environment_light
