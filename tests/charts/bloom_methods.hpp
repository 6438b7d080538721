// The bloom filters that charts and stability tests compare, and what both need to know about how each is
// drawn.
#pragma once

#include "04_pyramid_bloom/spline_sizes.hpp"
#include "charts/frames.hpp"
#include "support/choices.hpp"

#include <algorithm>
#include <filesystem>
#include <glm/vec2.hpp>
#include <set>
#include <string>
#include <vector>

namespace gll::charts {

// One way of drawing bloom: a rung, and settings over its defaults.
struct BloomMethod {
    std::string rung;
    std::string name;
    Set set;

    bool has(const std::string& setting, const std::string& value) const {
        const auto place = set.find(setting);
        return place != set.end() && place->second == value;
    }
    bool isPyramid() const { return rung != "03_gaussian_bloom"; }
    bool hasSplines() const { return has("down_filter", "spline"); }
    bool hasWeight() const { return rung == "05_hdr_bloom" && !has("karis", "none"); }
    bool halves() const { return has("blur", "half_resolution_5tap") || has("blur", "mipmap"); }

    // How many of a pyramid's levels add their light: all, or all but the largest.
    int addingLevels(int levels) const {
        return !isPyramid() ? 1 : has("finest", "off") ? levels - 1 : levels;
    }
    // Where a light is put in: the bright pass of 03 looks at no other pass.
    std::string firstPass() const { return isPyramid() ? "scene" : "bright"; }
    // Where it leaves its bloom, in full range. Splines give small frames one of the frame's own size.
    std::string target(glm::ivec2 size) const {
        if (!isPyramid()) return "blurred";
        return hasSplines() && std::min(size.x, size.y) < pyramid_bloom::smallest_large_px ? "bloom"
                                                                                           : "bloom0";
    }
};

// A pair of filters of 04_pyramid_bloom.
struct PyramidPair {
    const char* name;
    const char* down;
    const char* up;
    bool blurred = false;      // a Gaussian on every level
    const char* original = ""; // whose filters these are
};

// splines first
inline constexpr PyramidPair pyramid_pairs[] = {
    {"splines", "spline", "spline"},
    {"13 taps, tent", "13tap", "tent"},
    {"13 taps, Gaussian, tent", "13tap", "tent", true, "the original of 04"},
    {"5 taps, tent", "5tap", "tent", false, "the original of 05"},
    {"[1 3 3 1], tent", "4tap", "tent"},
    {"5 taps, dual filter", "5tap", "dual"},
    {"box, bilinear", "box", "bilinear"}};

// finest: whether the largest level adds its own light. What is added up is not divided by the number of
// levels.
inline BloomMethod pyramidMethod(const PyramidPair& pair, bool finest) {
    BloomMethod method{
        "04_pyramid_bloom",
        pair.name,
        {{"down_filter", pair.down}, {"up_filter", pair.up}, {"finest", finest ? "on" : "off"}}};
    if (!pair.blurred) method.set["blur"] = "none";
    return method;
}

// A blur of 03_gaussian_bloom.
struct Blur {
    const char* name;
    const char* setting;
    const char* original = "";
};

inline constexpr Blur gaussian_blurs[] = {
    {"ping-pong, 9 taps", "ping_pong_9tap", "the original of 03"},
    {"ping-pong, 5 fetches", "ping_pong_5fetch"},
    {"half resolution, 5 taps", "half_resolution_5tap", "the second original of 03"},
    {"mipmap", "mipmap"},
    {"one wide Gaussian", "wide_gaussian"}};

// Throws std::runtime_error where 03 or 04 offers a filter that is in neither list and is not excused here.
inline void requireAllBloomFilters(const std::filesystem::path& programs) {
    std::set<std::string> downs, ups, blurs;
    for (const PyramidPair& pair : pyramid_pairs) {
        downs.insert(pair.down);
        ups.insert(pair.up);
    }
    for (const Blur& blur : gaussian_blurs)
        blurs.insert(blur.setting);
    const std::filesystem::path pyramid = programs / "04_pyramid_bloom";
    test::requireCovered(pyramid, "down_filter", downs,
                         {{"13tap_as_printed", "a misprint that adds light at every level"}});
    test::requireCovered(pyramid, "up_filter", ups,
                         {{"4tap", "nearly as dear as the tent, and less steady"}});
    test::requireCovered(programs / "03_gaussian_bloom", "blur", blurs);
}

} // namespace gll::charts
