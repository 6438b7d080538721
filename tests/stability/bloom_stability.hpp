// What the stability tests of bloom share: the methods on equal terms, lights put into single pixels, and the
// table of the pages.
#pragma once

#include "charts/bloom_methods.hpp"
#include "measure/errors.hpp"
#include "page_table.hpp"

#include <gtest/gtest.h>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace gll::stability {

using charts::decimals;
using charts::Frames;
using charts::Set;
using charts::shortNumber;
using measure::ColorImage;

inline constexpr double emitter = 1000;  // luminance of one pixel in the dark
inline constexpr int default_levels = 5; // of 04 and 05

using Method = charts::BloomMethod;

// Tables and bounds are of methods on equal terms: sums divided by the number of levels, and no light of the
// largest level, but where a column is about just that.
inline const Set equal_terms = {{"finest", "off"}, {"normalise", "on"}};

inline std::vector<Method> pyramids() {
    std::vector<Method> list;
    for (const charts::PyramidPair& pair : charts::pyramid_pairs) {
        Method method = charts::pyramidMethod(pair, false);
        method.set = method.set + equal_terms;
        if (method.hasSplines()) method.name += " (recommended)";
        list.push_back(method);
    }
    return list;
}
inline const std::size_t recommended_pyramid = 0; // of the list above

inline std::vector<Method> gaussians() {
    std::vector<Method> list;
    for (const charts::Blur& blur : charts::gaussian_blurs) {
        const std::string original = blur.original;
        list.push_back({"03_gaussian_bloom",
                        blur.name + (original.empty() ? "" : " (" + original + ")"),
                        {{"blur", blur.setting}}});
    }
    return list;
}

inline std::vector<Method> karisWeights() {
    const Set splines = {{"down_filter", "spline"}, {"up_filter", "spline"}};
    std::vector<Method> list;
    for (const char* karis : {"none", "average"})
        list.push_back(
            {"05_hdr_bloom",
             karis == std::string("none") ? "splines (recommended)" : std::string("splines, karis=") + karis,
             splines + equal_terms + Set{{"karis", karis}}});
    for (const std::string& karis : test::choicesOf(folders.programs / "05_hdr_bloom", "karis"))
        list.push_back({"05_hdr_bloom", "5 taps, karis=" + karis, equal_terms + Set{{"karis", karis}}});
    return list;
}

inline std::vector<Method> allMethods() {
    std::vector<Method> list;
    for (const auto& some : {gaussians(), pyramids(), karisWeights()})
        list.insert(list.end(), some.begin(), some.end());
    return list;
}

// What the guards are tried on: the largest level's own light is another way through the blending.
inline std::vector<Method> allMethodsAndTheOriginals() {
    std::vector<Method> list = allMethods();
    list.push_back({"04_pyramid_bloom", "the original of 04", {}});
    list.push_back({"05_hdr_bloom", "the original of 05", {}});
    return list;
}

inline double sum(const ColorImage& image) {
    double total = 0;
    for (const glm::dvec3& color : image.pixels)
        total += color.r + color.g + color.b;
    return total / 3;
}

inline std::string at(const std::string& pass, glm::ivec2 pixel, const std::string& value) {
    return pass + ":" + std::to_string(pixel.x) + "," + std::to_string(pixel.y) + ":" + value;
}
inline std::string at(const std::string& pass, glm::ivec2 pixel, double value) {
    return at(pass, pixel, shortNumber(value)); // values here have three digits
}

// What a pixel of a method's bloom stands for.
inline double areaOf(const ColorImage& bloom, glm::ivec2 size) {
    return double(size.x) * size.y / (double(bloom.width) * bloom.height);
}

class BloomStability : public testing::Test {
  protected:
    static void SetUpTestSuite() {
        charts::requireAllBloomFilters(folders.programs);
        folder = std::make_unique<test::TemporaryFolder>();
        charts::writeExr(*folder / "black.exr", ColorImage(8, 8));
        charts::writeExr(*folder / "grey.exr", ColorImage(8, 8, glm::dvec3(0.5)));
    }
    static void TearDownTestSuite() {
        for (const auto& [rung, table] : tables)
            table.check();
        folder.reset();
    }

    // The frames of a test: one process a rung, for each start loads the driver and compiles anew.
    class Runs {
      public:
        explicit Runs(const char* image) : image_(image) {} // null: the rungs' own scenes
        Frames& of(const std::string& rung) {
            std::vector<std::string> arguments;
            if (image_ != nullptr) arguments = {"--image", (*folder / image_).string()};
            return runs_.try_emplace(rung, folders.programs / rung, arguments).first->second;
        }
        void run() {
            for (auto& [rung, frames] : runs_)
                frames.run();
        }

      private:
        const char* image_;
        std::map<std::string, Frames> runs_;
    };

    static void tell(const Method& method, const std::string& failure, const std::string& number) {
        std::printf("%s, %s: %s %s\n", method.rung.c_str(), method.name.c_str(), failure.c_str(),
                    number.c_str());
        tables.try_emplace(method.rung, method.rung).first->second.set(method.name, failure, number);
    }

    static inline std::unique_ptr<test::TemporaryFolder> folder;
    static inline std::map<std::string, PageTable> tables;
};

} // namespace gll::stability
