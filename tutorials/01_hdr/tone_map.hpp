// Tone mapping and the display's encoding as settings, for every rung whose last pass includes
// lib/tone_map.glsl and lib/encode.glsl.
#pragma once

#include "gl/pass.hpp"
#include "rung/settings.hpp"

#include <array>
#include <cmath>

namespace gll {
inline namespace hdr { // inline, because most rungs use it

inline constexpr std::array tone_maps = {
    "clamp",    "reinhard",       "reinhard_luminance", "reinhard_extended",
    "exposure", "aces_narkowicz", "aces_hill",          "pbr_neutral",
    "agx"};
inline constexpr std::array encodings = {"gamma22", "srgb"};

struct ToneMapOptions {
    // Declares the settings with a rung's own defaults.
    ToneMapOptions(Settings& settings, std::string_view default_tone_map, std::string_view default_encode,
                   double default_white_point = 4)
        : exposure_ev(settings.number("exposure_ev", 0, -16, 16, "exposure before tone mapping, stops")),
          tone_map(settings.choice("tone_map", default_tone_map, {tone_maps.begin(), tone_maps.end()},
                                   "from scene light to display light")),
          white_point(settings.number("white_point", default_white_point, 0.01, 65504,
                                      "luminance that becomes white; for reinhard_extended")),
          encode(settings.choice("encode", default_encode, {encodings.begin(), encodings.end()},
                                 "transfer function for the display")) {
        settings.shared("01_hdr", {"exposure_ev", "tone_map", "white_point", "encode"});
        settings.group(Setting::Group::tone, {"exposure_ev", "tone_map", "white_point", "encode"});
        settings.needs({"white_point"}, {{"tone_map", {"reinhard_extended"}}});
    }

    // For shaders that include lib/tone_map.glsl and lib/encode.glsl.
    Defines defines() const { return tone_map.defines() + encode.defines(); }
    ShaderPart part() const {
        return {.defines = defines(),
                .uniforms = {{"exposure", std::exp2(exposure_ev)}, {"white_point", white_point}}};
    }

    Number exposure_ev;
    Choice tone_map;
    Number white_point;
    Choice encode;
};

} // namespace hdr
} // namespace gll
