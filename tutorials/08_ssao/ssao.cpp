// Occlusion's passes.
#include "ssao.hpp"

#include <cmath>
#include <glm/gtc/matrix_access.hpp>

namespace gll::ssao {
namespace {

// Two numbers for each cell of a square that is repeated over the screen: those of the sequence R2 (Roberts
// 2018, "The Unreasonable Effectiveness of Quasirandom Sequences") along Hilbert's curve, so that pixels that
// are near each other have numbers that lie far apart. XeGTAO (Intel 2021) uses the same.
Texture makeNoise() {
    constexpr int order = 6;
    constexpr int side = 1 << order;
    std::vector<float> values;
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
            const double index = hilbertIndex(x, y, order);
            for (const double step : {0.75487766624669276, 0.56984029099805327}) {
                const double value = 0.5 + index * step;
                values.push_back(static_cast<float>(value - std::floor(value)));
            }
        }
    return Texture({.size = {side, side},
                    .format = Format::rg16,
                    .filter = Filter::nearest,
                    .wrap_x = Wrap::repeat,
                    .wrap_y = Wrap::repeat},
                   values);
}

} // namespace

int hilbertIndex(int x, int y, int order) {
    int index = 0;
    for (int half = 1 << (order - 1); half > 0; half /= 2) {
        const int right = (x & half) != 0 ? 1 : 0;
        const int up = (y & half) != 0 ? 1 : 0;
        index += half * half * ((3 * right) ^ up);
        if (up != 0) continue;
        // the quarter below is turned: the curve enters and leaves it where its neighbours want it
        if (right != 0) {
            x = (1 << order) - 1 - x;
            y = (1 << order) - 1 - y;
        }
        std::swap(x, y);
    }
    return index;
}

SsaoOptions::SsaoOptions(Settings& settings)
    : method(settings.choice(
          "ssao", "cone", {"off", "cone", "hemisphere", "sao", "hbao", "gtao", "bitmask"},
          "how occluders are sought: along a cone, in a hemisphere, on a disk, by horizons, by sectors")),
      ssao_normals(
          settings.choice("ssao_normals", "mapped", {"mapped", "geometric", "depth"},
                          "the normals of shading, the surface's own where they are stored, or those "
                          "that depth tells")),
      noise(settings.choice("ssao_noise", "hash", {"hash", "interleaved", "hilbert"},
                            "what differs from pixel to pixel: hashed, 16 in a 4x4 pattern, R2 on a curve")),
      ssao_blur(settings.choice("ssao_blur", "off", {"off", "separable", "plane"},
                                "averages 4x4 pixels of one distance, or 5x5 of one plane")),
      resolution(settings.choice("ssao_resolution", "full", {"full", "half"},
                                 "occlusion for each pixel, or for a quarter of them")),
      samples(settings.integer("ssao_samples", 16, 1, 64, "taps a pixel")),
      slices(settings.integer("ssao_slices", 2, 1, 32,
                              "hbao, gtao, bitmask: directions in which occluders are sought, both ways")),
      spacing(settings.choice("ssao_spacing", "squared", {"even", "squared"},
                              "hbao, gtao, bitmask: taps along a slice, even or closer together near the "
                              "pixel")),
      radius(settings.number("ssao_radius", 0.6, 0.01, 10, "how far occluders are sought, units")),
      bias(settings.number("ssao_bias", 0.03, 0, 1, "how much nearer an occluder must be, units")),
      strength(
          settings.number("ssao_strength", 1.7, 0, 10, "factor on the occlusion; not for gtao and bitmask")),
      power(settings.number("ssao_power", 1, 0.1, 10, "exponent on the visibility")),
      falloff(settings.number("ssao_falloff", 0.6, 0, 1,
                              "gtao: the outer part of the radius over which occluders fade")),
      thickness(settings.number("ssao_thickness", 0.6, 0.001, 100,
                                "bitmask: how thick what is seen is taken to be, units")),
      sectors(settings.choice("ssao_sectors", "cosine", {"uniform", "cosine"},
                              "bitmask: 32 sectors of one angle, or of one share of a matt surface's light")),
      rounding(settings.choice("ssao_rounding", "round", {"floor", "round", "ceil"},
                               "bitmask: which sectors an occluder takes that it covers in part")),
      multi_bounce(settings.toggle("ssao_multi_bounce", false,
                                   "let light reach corners from the surfaces round them")) {
    settings.shared("08_ssao",
                    {"ssao", "ssao_normals", "ssao_noise", "ssao_blur", "ssao_resolution", "ssao_samples",
                     "ssao_slices", "ssao_spacing", "ssao_radius", "ssao_bias", "ssao_strength", "ssao_power",
                     "ssao_falloff", "ssao_thickness", "ssao_sectors", "ssao_rounding", "ssao_multi_bounce"});
    const std::vector<std::string> methods = {"cone", "hemisphere", "sao", "hbao", "gtao", "bitmask"};
    settings.needs({"ssao_normals", "ssao_noise", "ssao_blur", "ssao_resolution", "ssao_samples",
                    "ssao_radius", "ssao_bias", "ssao_power", "ssao_multi_bounce"},
                   {{"ssao", methods}});
    settings.needs({"ssao_slices", "ssao_spacing"}, {{"ssao", {"hbao", "gtao", "bitmask"}}});
    settings.needs({"ssao_strength"}, {{"ssao", {"cone", "hemisphere", "sao", "hbao"}}});
    settings.needs({"ssao_falloff"}, {{"ssao", {"gtao"}}});
    settings.needs({"ssao_thickness", "ssao_sectors", "ssao_rounding"}, {{"ssao", {"bitmask"}}});
}

// excerpt: occlusion
void Ssao::draw(Frame& frame, const gbuffer::View& view, const ShaderPart& gbuffer,
                const SsaoOptions& options) {
    if (!options.isOn()) return;
    const glm::ivec2 size = options.isHalved() ? (frame.size() + 1) / 2 : frame.size();
    if (options.isHalved())
        occlusion_.remake({{.name = "ssao", .format = Format::rg16f, .filter = Filter::nearest}}, size);
    else
        occlusion_.remake({{.name = "ssao", .format = Format::r8}}, size);
    const Defines defines = gbuffer.defines + options.method.defines() + options.noise.defines() +
                            options.ssao_normals.defines() + options.spacing.defines() +
                            options.sectors.defines() + options.rounding.defines() +
                            Defines{{"WITH_WEIGHT", options.isBlurred() ? "1" : "0"},
                                    {"WITH_VIEW_Z", options.isHalved() ? "1" : "0"},
                                    {"WITH_POWER", options.power == 1.0F ? "0" : "1"},
                                    {"SSAO_SAMPLES", std::to_string(int(options.samples))},
                                    {"SSAO_SLICES", std::to_string(int(options.slices))},
                                    {"SSAO_STEPS", std::to_string(options.steps())}};
    ShaderPart part = gbuffer;
    if (options.noise == "hilbert") {
        if (!noise_) noise_ = makeNoise();
        part.inputs.push_back({"ssao_noise_map", *noise_});
    }
    const glm::vec2 scale(view.clip_from_view[0][0], view.clip_from_view[1][1]);
    part += {.uniforms = {{"half_uv_from_view", 0.5F * scale},
                          {"pixel_step", options.isHalved() ? 2 : 1},
                          {"radius", options.radius},
                          {"bias", options.bias},
                          {"strength", options.strength},
                          {"power", options.power},
                          {"falloff", options.falloff},
                          {"thickness", options.thickness}}};
    for (Framebuffer& noisy : noisy_)
        if (options.isBlurred()) noisy.resize(size);
    frame.pass("ssao", options.isBlurred() ? noisy_[0] : occlusion_,
               {.program = shaders_.fullScreen("08_ssao/ssao.frag", defines), .part = part});

    const auto blur = [&](const std::string& name, const Framebuffer& from, const Framebuffer& to,
                          glm::ivec2 along) {
        const bool is_last = &to == &occlusion_;
        frame.pass(
            name, to,
            {.program = shaders_.fullScreen(
                 along == glm::ivec2(1) ? "08_ssao/blur_plane.frag" : "08_ssao/blur.frag",
                 {{"WITH_WEIGHT", is_last ? "0" : "1"}, {"WITH_VIEW_Z", options.isHalved() ? "1" : "0"}}),
             .inputs = {{"occlusion", from.color()}},
             .uniforms = {{"uv_step", glm::vec2(along) / glm::vec2(size)}}});
    };
    if (options.ssao_blur == "separable") {
        blur("ssao_blur_x", noisy_[0], noisy_[1], {1, 0});
        blur("ssao_blur_y", noisy_[1], occlusion_, {0, 1});
    } else if (options.ssao_blur == "plane")
        blur("ssao_blur", noisy_[0], occlusion_, {1, 1});
}
// end excerpt

ShaderPart Ssao::part(const gbuffer::View& view, const SsaoOptions& options) const {
    return {.defines = options.method.defines() + options.resolution.defines() +
                       Defines{{"SSAO_MULTI_BOUNCE", options.multi_bounce ? "1" : "0"}},
            .inputs = {{"ssao_map", occlusion_.color()}},
            .uniforms = {{"view_z_from_world", glm::row(view.view_from_world, 2)}}};
}

} // namespace gll::ssao
