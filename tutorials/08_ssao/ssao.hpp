// Ambient occlusion from what the G-buffer holds: how much of the light from all round reaches each pixel.
#pragma once

#include "06_gbuffer/gbuffer.hpp"

#include <array>
#include <optional>

namespace gll::ssao {

struct SsaoOptions {
    // Declares the settings. Every rung but 08 shares them.
    explicit SsaoOptions(Settings& settings);

    Choice method;
    Choice ssao_normals;
    Choice noise;
    Choice ssao_blur;
    Choice resolution;
    Integer samples;
    Integer slices;
    Choice spacing;
    Number radius;
    Number bias;
    Number strength;
    Number power;
    Number falloff;
    Number thickness;
    Choice sectors;
    Choice rounding;
    Toggle multi_bounce;

    bool isOn() const { return !(method == "off"); }
    bool isBlurred() const { return !(ssao_blur == "off"); }
    bool isHalved() const { return resolution == "half"; }
    // Taps from the pixel to either end of a slice.
    int steps() const { return std::max(samples / (2 * slices), 1); }
    // Whether it asks for the G-buffer's geometric normal, see gbuffer::GBufferOptions::geometric.
    bool usesGeometry() const { return isOn() && ssao_normals == "geometric"; }
};

class Ssao {
  public:
    explicit Ssao(ShaderLibrary& shaders) : shaders_(shaders) {}

    // Passes "ssao" and, for what blurs it, "ssao_blur_x" and "_y", or "ssao_blur": the share of the light
    // from all round that is not occluded, [0, 1], into target "ssao". None where the method is off.
    void draw(Frame& frame, const gbuffer::View& view, const ShaderPart& gbuffer, const SsaoOptions& options);

    // For shaders that include 08_ssao/read_ssao.glsl. Valid until the next draw().
    ShaderPart part(const gbuffer::View& view, const SsaoOptions& options) const;

  private:
    ShaderLibrary& shaders_;
    std::optional<Texture> noise_; // made when first used
    // r: visibility; g, at half the resolution and before a blur: view z, by which the passes that follow
    // tell surfaces apart
    Framebuffer occlusion_{{{.name = "ssao", .format = Format::r8}}, {1, 1}}; // bound even where off
    std::array<Framebuffer, 2> noisy_{
        Framebuffer({{.name = "ssao_noisy", .format = Format::rgba16f, .filter = Filter::nearest}}, {1, 1}),
        Framebuffer({{.name = "ssao_half_blurred", .format = Format::rgba16f, .filter = Filter::nearest}},
                    {1, 1})};
};

// The place along Hilbert's curve through a square of side 2^order cells, 0 to 4^order - 1: neighbours along
// the curve are neighbours in the square.
int hilbertIndex(int x, int y, int order);

} // namespace gll::ssao
