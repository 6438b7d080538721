// The rule that a frame is held to where it is not the reference bit for bit, and what was measured of it.
#pragma once

#include "measure/comparison.hpp"
#include "measure/flip.hpp"

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

namespace gll::frame_check {

// Measured on the ladder's frames (58 faults in shaders, three versions of Mesa): a real fault moves many
// pixels by few codes, another Mesa moves few pixels by one code. So differing pixels are counted, and a few
// along edges may differ by more; but not by much, for then a pixel shows something else. Without AVX,
// 266 of 377 frames stay within it; those that do not jump where the last bit of a coordinate is another, by
// any number of codes.
struct Rule {
    enum class Kind {
        count, // how far and how many: the two knobs below
        exact, // no pixel differs
        flip,  // the mean of FLIP is at most `limit`
        rmse,  // the root of the mean squared difference of display values is at most `limit`
    };
    static constexpr int usual_codes = 16;
    static constexpr double usual_share = 0.005;
    static constexpr int small_difference = 2; // codes; by more, only one pixel in 48 of those may differ

    Kind kind = Kind::count;
    int codes = usual_codes;    // how far: no pixel differs by more
    double share = usual_share; // how many: the share of the frame's pixels that may differ at all
    double limit = 0;
    std::string because = {}; // why it is looser than usual; never empty where it is

    bool isLoosened() const;
    // Of count, in a frame of so many pixels: how many may differ, and how many by more than
    // small_difference.
    std::size_t mostDiffering(std::size_t pixels) const;
    std::size_t mostExceeding(std::size_t pixels) const;
    std::string text() const; // "count", "count, 24 codes, 1 % of the pixels", "exact", "flip=0.01"
};

// The most that any case can ask for: beyond, a frame that shows something else would pass.
inline constexpr int most_rule_codes = 64;
inline constexpr double most_rule_share = 0.05;
inline constexpr double most_rule_flip = 0.1; // three codes of blue more in every pixel are 0.05
inline constexpr double most_rule_rmse = 0.05;

// "count", "exact", "flip=X" or "rmse=X". Throws std::runtime_error for anything else, and beyond the caps.
Rule ruleFromText(const std::string& text);

// Such a text, or an object: {"count": {"codes": 24, "pixels": 0.01}, "because": "..."} with either knob or
// both, or {"flip": X, "because": "..."}, {"rmse": X, "because": "..."}. Throws std::runtime_error where it
// is neither, where a knob is beyond its cap, and where a rule looser than "count" has no reason.
Rule ruleFromJson(const nlohmann::json& json);

// What is known of a frame beside its reference.
struct Measurement {
    measure::Comparison comparison = {};
    std::optional<double> flip_mean = {}; // none where they cannot be compared or a color is no finite number
    std::optional<Image> flip_map =
        {}; // 8-bit grey: FLIP times 255, rounded up so that nothing that is there is 0

    double psnrDb() const;
    // "differ 12 (0.016 %)  worst 9 at (5,7)  RMSE 0.0012  PSNR 58.4 dB  FLIP 0.0004"
    std::string line() const;
};

// FLIP is 0 where nothing differs, and its map is kept only where it is wanted.
Measurement measure(const Image& reference, const Image& image, bool keep_map);

// Whether the rule lets it pass; never where the two cannot be compared.
bool satisfies(const Rule& rule, const Measurement& measurement);

} // namespace gll::frame_check
