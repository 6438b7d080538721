// Where bloom breaks, in 03, 04 and 05: each failure provoked in every method, its number printed, the
// recommended method held to a bound, and those known to be bad expected to break it still.
#include "charts/bloom_methods.hpp"
#include "measure/errors.hpp"
#include "page_table.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/common.hpp>
#include <gtest/gtest.h>
#include <random>

namespace gll::stability {
namespace {

using charts::decimals;
using charts::Frames;
using charts::Set;
using charts::shortNumber;
using measure::ColorImage;

constexpr double emitter = 1000;  // luminance of one pixel in the dark
constexpr int default_levels = 5; // of 04 and 05

using Method = charts::BloomMethod;

// Tables and bounds are of methods on equal terms: sums divided by the number of levels, and no light of the
// largest level, but where a column is about just that.
const Set equal_terms = {{"finest", "off"}, {"normalise", "on"}};

std::vector<Method> pyramids() {
    std::vector<Method> list;
    for (const charts::PyramidPair& pair : charts::pyramid_pairs) {
        Method method = charts::pyramidMethod(pair, false);
        method.set = method.set + equal_terms;
        if (method.hasSplines()) method.name += " (recommended)";
        list.push_back(method);
    }
    return list;
}
const std::size_t recommended_pyramid = 0; // of the list above

std::vector<Method> gaussians() {
    std::vector<Method> list;
    for (const charts::Blur& blur : charts::gaussian_blurs) {
        const std::string original = blur.original;
        list.push_back({"03_gaussian_bloom",
                        blur.name + (original.empty() ? "" : " (" + original + ")"),
                        {{"blur", blur.setting}}});
    }
    return list;
}

std::vector<Method> karisWeights() {
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

std::vector<Method> allMethods() {
    std::vector<Method> list;
    for (const auto& some : {gaussians(), pyramids(), karisWeights()})
        list.insert(list.end(), some.begin(), some.end());
    return list;
}

// What the guards are tried on: the largest level's own light is another way through the blending.
std::vector<Method> allMethodsAndTheOriginals() {
    std::vector<Method> list = allMethods();
    list.push_back({"04_pyramid_bloom", "the original of 04", {}});
    list.push_back({"05_hdr_bloom", "the original of 05", {}});
    return list;
}

double sum(const ColorImage& image) {
    double total = 0;
    for (const glm::dvec3& color : image.pixels)
        total += color.r + color.g + color.b;
    return total / 3;
}

std::string at(const std::string& pass, glm::ivec2 pixel, const std::string& value) {
    return pass + ":" + std::to_string(pixel.x) + "," + std::to_string(pixel.y) + ":" + value;
}
std::string at(const std::string& pass, glm::ivec2 pixel, double value) {
    return at(pass, pixel, shortNumber(value)); // values here have three digits
}

// What a pixel of a method's bloom stands for.
double areaOf(const ColorImage& bloom, glm::ivec2 size) {
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

    // The frames of a test: one process a rung, for each start loads OpenImageIO and compiles anew.
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

// A light of 1000 at one pixel, anywhere in frames of the sizes: the light in the picture over that of a
// frame without bloom, less 1, should be the strength.
const std::vector<glm::ivec2> odd_sizes = {{3, 3}, {7, 9}, {33, 47}, {101, 77}, {333, 250}, {641, 479}};

TEST_F(BloomStability, splinesKeepTheLightAtEverySizeAndTheOtherPyramidsDoNot) {
    std::vector<glm::ivec2> sizes = odd_sizes;
    for (int side = 2; side <= 40; ++side)
        sizes.emplace_back(side);
    for (const glm::ivec2 size :
         {glm::ivec2(2, 77), {91, 3}, {65, 129}, {255, 257}, {500, 500}, {1023, 1025}, {2048, 2047}})
        sizes.push_back(size);
    const std::vector<Method> list = pyramids();
    Runs runs("black.exr");
    std::vector<std::vector<std::size_t>> asked(list.size());
    for (std::size_t m = 0; m < list.size(); ++m) {
        std::mt19937 random(1); // its sequence is the standard's, the same everywhere
        for (const glm::ivec2 size : m == recommended_pyramid ? sizes : odd_sizes)
            for (int i = 0; i < (size.x < 1000 ? 2 : 1); ++i) {
                const auto x = static_cast<int>(random() % static_cast<unsigned>(size.x));
                const auto y = static_cast<int>(random() % static_cast<unsigned>(size.y));
                // The composite is half floats: a strength of 64 keeps the added light well above their
                // steps.
                asked[m].push_back(runs.of(list[m].rung)
                                       .ask(list[m].set + Set{{"threshold", "0"}, {"strength", "64"}}, size,
                                            "lit", at("scene", {x, y}, emitter)));
            }
    }
    runs.run();
    for (std::size_t m = 0; m < list.size(); ++m) {
        double error = 0;
        for (const std::size_t i : asked[m]) {
            const double light = sum(runs.of(list[m].rung).read(i));
            error = std::max(error, std::abs((light - emitter) / (64 * emitter) - 1));
        }
        tell(list[m], "light at odd sizes off by %", shortNumber(100 * error));
        if (m == recommended_pyramid) {
            EXPECT_LE(error, 0.005); // what is promised of it, to 2048x2047
        } else {
            EXPECT_GT(error, 0.2) << list[m].name << " is " << news;
        }
    }
}

// At the edges all blurs of 03 count some light twice, as clamped ones do: the light stands in the middle.
TEST_F(BloomStability, blursAtFullSizeKeepTheLightAtOddSizesAndThoseAtHalfDoNot) {
    Runs runs(nullptr);
    struct Asked {
        Method method;
        glm::ivec2 size;
        std::size_t frame;
    };
    std::vector<Asked> asked;
    for (const Method& method : gaussians())
        for (const glm::ivec2 size : {glm::ivec2(128, 128), {101, 97}, {127, 129}, {201, 151}})
            for (int i = 0; i < 4; ++i)
                asked.push_back({method, size,
                                 runs.of(method.rung)
                                     .ask(method.set + Set{{"threshold", "1000"}}, size, "blurred",
                                          at("bright", size / 2 + glm::ivec2(i % 2, i / 2), emitter))});
    runs.run();
    for (const Method& method : gaussians()) {
        double even = 0;
        double odd = 0;
        for (const Asked& one : asked) {
            if (one.method.name != method.name) continue;
            const ColorImage bloom = runs.of(method.rung).read(one.frame);
            double& largest = one.size == glm::ivec2(128) ? even : odd;
            largest = std::max(largest, std::abs(sum(bloom) * areaOf(bloom, one.size) / emitter - 1));
        }
        tell(method, "light at 128x128 off by %", shortNumber(100 * even));
        tell(method, "light at odd sizes off by %", shortNumber(100 * odd));
        if (method.halves()) {
            EXPECT_GT(odd, 0.2) << method.name << " is " << news;
        } else {
            EXPECT_LE(odd, 0.01) << method.name; // ten stores of half floats, each of which may truncate
        }
    }
}

TEST_F(BloomStability, aFlatFieldStaysFlat) {
    Runs runs("grey.exr");
    const Method method = pyramids()[recommended_pyramid];
    Frames& all = runs.of(method.rung);
    std::vector<std::size_t> asked;
    for (const glm::ivec2 size : {glm::ivec2(1, 1), {3, 5}, {63, 64}, {101, 77}, {333, 200}})
        asked.push_back(all.ask(method.set + Set{{"threshold", "0"}, {"strength", "1"}}, size, "lit"));
    runs.run();
    double largest = 0;
    for (const std::size_t i : asked)
        for (const glm::dvec3& color : all.read(i).pixels)
            largest = std::max(largest, std::abs(color.r - 1));
    std::printf("flat field of 0.5 with a bloom of strength 1: at most %.2g from 1\n", largest);
    EXPECT_LE(largest, 0.005); // eleven stores of half floats, each of which may truncate
}

// The light goes over one period of the pyramid, in whole pixels along a row. Each pyramid with and without
// the light of its largest level.
TEST_F(BloomStability, aSplinesGlowDoesNotDependOnTheGridAndTheOthersDo) {
    const glm::ivec2 size(256, 128);
    const auto period = [](const Method& method) { return method.isPyramid() ? 32 : 2; };
    Runs runs("black.exr");
    struct Asked {
        Method method;
        bool finest;
        std::vector<std::size_t> frames = {};
    };
    std::vector<Asked> asked;
    for (const Method& method : allMethods()) {
        asked.push_back({method, false});
        if (!method.isPyramid()) continue;
        asked.push_back({method, true});
        asked.back().method.set["finest"] = "on";
    }
    for (Asked& one : asked)
        for (int i = 0; i < period(one.method); ++i)
            one.frames.push_back(runs.of(one.method.rung)
                                     .ask(one.method.set, size, one.method.target(size),
                                          at(one.method.firstPass(), size / 2 + glm::ivec2(i, 0), emitter)));
    runs.run();
    double without = 0;
    for (const Asked& one : asked) {
        const Method& method = one.method;
        std::vector<ColorImage> responses;
        std::vector<glm::ivec2> shifts;
        for (const std::size_t i : one.frames) {
            shifts.emplace_back(static_cast<int>(shifts.size()), 0);
            responses.push_back(charts::resized(runs.of(method.rung).read(i), size.x, size.y));
        }
        const double variance = measure::shiftVariance(responses, shifts, period(method)).mean;
        tell(method,
             one.finest ? "the same, with the finest level's light"
                        : "glow depends on the place: shift variance %",
             decimals(100 * variance, 2));
        const bool steady = method.hasSplines() && !method.hasWeight();
        if (one.finest) {
            // Of boxes all levels are as bad as the first.
            if (!method.has("down_filter", "box")) {
                EXPECT_GT(variance, 1.3 * without) << method.name << ": its finest level does no harm";
            }
        } else if (!method.isPyramid() && !method.halves()) {
            EXPECT_LE(variance, 1e-6) << method.name; // the same taps at every pixel
        } else if (steady) {
            EXPECT_LE(variance, 0.01) << method.name; // what is promised of them
        } else {
            EXPECT_GT(variance, 0.02) << method.name << " is " << news;
        }
        without = variance;
    }
}

// A light as large as a pixel, 1000 times as bright as white, moved over two pixels in sixteenths: as a
// raster has it where edges are smoothed, two pixels share its light.
TEST_F(BloomStability, aMovingFireflyShimmersWhereAWeightPressesItDownAndNotWhereAllIsLinear) {
    const glm::ivec2 size(128, 64);
    constexpr int steps = 2 * 16;
    const std::vector<Method> list = allMethods();
    Runs runs("black.exr");
    std::vector<std::vector<std::size_t>> asked(list.size());
    for (std::size_t m = 0; m < list.size(); ++m)
        for (int step = 0; step < steps; ++step) {
            const glm::ivec2 first = size / 2 + glm::ivec2(step / 16, 0);
            const double share = (step % 16) / 16.0;
            const std::string pass = list[m].firstPass();
            asked[m].push_back(runs.of(list[m].rung)
                                   .ask(list[m].set, size, list[m].target(size),
                                        {at(pass, first, decimals(emitter * (1 - share), 1)),
                                         at(pass, first + glm::ivec2(1, 0), decimals(emitter * share, 1))}));
        }
    runs.run();
    for (std::size_t m = 0; m < list.size(); ++m) {
        const Method& method = list[m];
        std::vector<double> lights;
        double mean = 0;
        for (const std::size_t i : asked[m]) {
            const ColorImage bloom = runs.of(method.rung).read(i);
            lights.push_back(sum(bloom) * areaOf(bloom, size) / emitter /
                             method.addingLevels(default_levels));
            mean += lights.back() / steps;
        }
        double variance = 0;
        for (const double light : lights)
            variance += (light - mean) * (light - mean) / steps;
        const double variation = std::sqrt(variance) / mean;
        tell(method, "firefly: its light varies by %", decimals(100 * variation, 1));
        if (method.hasWeight()) {
            tell(method, "firefly: light that is left %", decimals(100 * mean, 1));
            EXPECT_GT(variation, 0.05) << method.name << " is " << news;
        } else {
            EXPECT_LE(variation, 0.005) << method.name;
            if (method.rung == "05_hdr_bloom")
                tell(method, "firefly: light that is left %", decimals(100 * mean, 1));
        }
    }
}

// A ramp of luminance through the threshold: how much the bright pass's output rises for what goes in.
TEST_F(BloomStability, aKneeKeepsAHighlightFromPoppingAndWithoutOneItPops) {
    ColorImage ramp(2048, 2);
    for (int y = 0; y < 2; ++y)
        for (int x = 0; x < ramp.width; ++x)
            ramp.at(x, y) = glm::dvec3(0.2 + 1.4 * x / ramp.width);
    charts::writeExr(*folder / "ramp.exr", ramp);
    struct Case {
        const char* rung;
        Set set;
        bool pops;
        std::size_t frame = 0;
    };
    std::vector<Case> cases = {
        {"04_pyramid_bloom", {{"soft_knee", "0.5"}}, false},
        {"04_pyramid_bloom", pyramids()[recommended_pyramid].set + Set{{"soft_knee", "0.5"}}, false},
        {"05_hdr_bloom", {{"knee", "0.6"}, {"karis", "none"}}, false},
        {"03_gaussian_bloom", {}, true},
        {"04_pyramid_bloom", {{"soft_knee", "0"}}, true},
        {"05_hdr_bloom", {{"knee", "0"}, {"karis", "none"}}, true}};
    Runs runs("ramp.exr");
    for (Case& one : cases)
        one.frame = runs.of(one.rung).ask(one.set, {ramp.width, ramp.height}, "bright");
    runs.run();
    for (const Case& one : cases) {
        // Throws where a value is not finite: of equal edges, GLSL's smoothstep need not give a number.
        const ColorImage out = runs.of(one.rung).read(one.frame);
        const double step = 1.4 / out.width;
        double steepest = 0;
        for (int x = 1; x < out.width; ++x)
            steepest = std::max(steepest, (out.at(x, 0).g - out.at(x - 1, 0).g) / step);
        std::string text;
        for (const auto& [name, value] : one.set)
            text += " " + name + "=" + value;
        std::printf("largest rise of the bright pass to a rise in luminance: %s%s: %.2f\n", one.rung,
                    text.c_str(), steepest);
        if (one.pops) { // all at once: the steeper, the finer the ramp
            EXPECT_GT(steepest, 100) << one.rung << " is " << news;
        } else { // the smooth step's own slope, at the threshold: luminance * 1.5 / (2 * half its width) +
                 // 1/2
            EXPECT_LE(steepest, 3) << one.rung;
        }
    }
}

// A pass that a bad value can be put into, and the size of what it draws.
struct Place {
    std::string pass;
    glm::ivec2 size;
};

// Those of a method's passes that are read again before the bloom is added to the picture.
std::vector<Place> placesIn(const Method& method, glm::ivec2 size) {
    if (!method.isPyramid()) {
        const std::string blur = method.set.at("blur");
        const glm::ivec2 inner = method.halves() ? size / 2 : size;
        std::vector<Place> places = {{"scene", size}, {"bright", size}};
        const int pairs = blur == "mipmap" ? 0 : blur == "wide_gaussian" ? 1 : 5;
        for (int i = 1; i <= pairs; ++i) {
            places.push_back({"horizontal" + std::to_string(i), inner});
            if (i < pairs) places.push_back({"vertical" + std::to_string(i), inner});
        }
        return places;
    }
    std::vector<glm::ivec2> levels;
    for (glm::ivec2 level = size; levels.size() < 5;)
        levels.push_back(level = glm::max((level + (method.hasSplines() ? 1 : 0)) / 2, 1));
    std::vector<Place> places = {{"scene", size}, {"bright", levels[0]}};
    for (std::size_t i = 1; i < levels.size(); ++i)
        places.push_back({"down" + std::to_string(i), levels[i]});
    const bool in_04 = method.rung == "04_pyramid_bloom";
    const bool blurs = in_04 && !method.set.contains("blur");
    for (std::size_t i = 0; blurs && i < levels.size(); ++i)
        for (const char* direction : {"blur_x", "blur_y"})
            places.push_back({direction + std::to_string(i), levels[i]});
    const bool full = method.target(size) == "bloom";
    for (std::size_t i = levels.size() - 1; i-- > (full || in_04 ? 0U : 1U);)
        places.push_back({"up" + std::to_string(i), levels[i]});
    if (full && in_04) places.push_back({"up", size});
    return places;
}

// What is looked at in the end: with 04, the picture in full range. 03 and 05 add the bloom in the pass that
// shows the frame, behind one more guard: there it is looked at before.
std::string lastTarget(const Method& method, glm::ivec2 size) {
    return method.rung == "04_pyramid_bloom" ? "lit" : method.target(size);
}

// Pixels with a channel that is infinite or not a number, but for the one overwritten where that is in the
// very texture looked at: the largest level of 05, which receives the others' light.
int notFinite(const std::filesystem::path& file, const Method& method, const Place& place) {
    const Image image = loadImage(file);
    const auto& values = std::get<std::vector<float>>(image.pixels);
    const auto channels = static_cast<std::size_t>(image.channels);
    int bad = 0;
    for (std::size_t i = 0; i < values.size(); i += channels)
        if (!std::isfinite(values[i]) || !std::isfinite(values[i + 1]) || !std::isfinite(values[i + 2]))
            ++bad;
    const bool same = method.rung == "05_hdr_bloom" && !method.has("finest", "off") && place.pass == "bright";
    return same ? std::max(bad - 1, 0) : bad;
}

TEST_F(BloomStability, withoutGuardsOneBadPixelOfTheBrightPassTakesMuchOfTheFrame) {
    const glm::ivec2 size(160, 120);
    const std::vector<Method> list = allMethods();
    Runs runs("grey.exr");
    std::vector<std::size_t> asked;
    for (const Method& method : list)
        asked.push_back(runs.of(method.rung)
                            .ask(method.set + Set{{"guard", "off"}}, size, lastTarget(method, size),
                                 at("bright", placesIn(method, size)[1].size / 2, "nan")));
    runs.run();
    for (std::size_t m = 0; m < list.size(); ++m) {
        const std::filesystem::path file = runs.of(list[m].rung).file(asked[m]);
        const Image image = loadImage(file);
        const double lost = notFinite(file, list[m], {}) / (double(image.width) * image.height);
        tell(list[m], "one bad pixel in bright: % lost without guards", decimals(100 * lost, 1));
        tell(list[m], "with guards", "0");
        if (list[m].has("blur", "mipmap")) {
            EXPECT_LE(lost, 0.001) << "nothing carries it further";
        } else {
            EXPECT_GT(lost, 0.1) << list[m].name << " is " << news;
        }
    }
}

TEST_F(BloomStability, withGuardsNoBadValueInAnyPassReachesThePicture) {
    const glm::ivec2 size(40, 30);
    struct Asked {
        Method method;
        Place place;
        std::string what;
        std::size_t frame;
    };
    Runs runs("grey.exr");
    std::vector<Asked> asked;
    const auto ask = [&](const Method& method, glm::ivec2 frame_size, const Place& place, glm::ivec2 pixel,
                         const char* value) {
        const std::string where = at(place.pass, pixel, value);
        asked.push_back({method, place, where,
                         runs.of(method.rung)
                             .ask(method.set + Set{{"threshold", "0"}}, frame_size,
                                  lastTarget(method, frame_size), where)});
    };
    for (const Method& method : allMethodsAndTheOriginals())
        for (const Place& place : placesIn(method, size))
            for (const char* value : {"nan", "inf", "-inf"})
                ask(method, size, place, place.size / 2, value);
    // And any pixel of any target, in frames so small that all can be tried.
    const glm::ivec2 tiny(12, 10);
    for (const Method& method :
         {gaussians()[0], gaussians()[2], pyramids()[recommended_pyramid], pyramids()[1], karisWeights()[2]})
        for (const Place& place : placesIn(method, tiny))
            for (int y = 0; y < place.size.y; ++y)
                for (int x = 0; x < place.size.x; ++x)
                    ask(method, tiny, place, {x, y}, "nan");
    runs.run();
    for (const Asked& one : asked)
        ASSERT_EQ(notFinite(runs.of(one.method.rung).file(one.frame), one.method, one.place), 0)
            << one.method.rung << " " << one.method.name << " " << one.what;
    std::printf("%zu bad values, one by one in every pass: no pixel not finite in the end\n", asked.size());
}

TEST_F(BloomStability, guardsChangeNoFrameThatIsAsItShouldBe) {
    Runs runs(nullptr);
    const glm::ivec2 size(96, 72);
    std::vector<std::pair<std::size_t, std::size_t>> asked;
    const std::vector<Method> list = allMethodsAndTheOriginals();
    for (const Method& method : list) {
        Frames& all = runs.of(method.rung);
        const std::size_t on = all.ask(method.set, size, lastTarget(method, size));
        asked.emplace_back(on, all.ask(method.set + Set{{"guard", "off"}}, size, lastTarget(method, size)));
    }
    runs.run();
    for (std::size_t m = 0; m < list.size(); ++m) {
        const Frames& all = runs.of(list[m].rung);
        EXPECT_EQ(all.read(asked[m].first).pixels, all.read(asked[m].second).pixels)
            << list[m].rung << " " << list[m].name;
    }
}

// Light from 1e-7 to 1e38 everywhere. More than 65504 is stored as that or as infinite, as the driver does;
// an infinite pixel counts as none, so that a division by zero does not outshine everything.
TEST_F(BloomStability, lightOfAnyStrengthGivesAFiniteBloomThatGrowsWithIt) {
    const glm::ivec2 size(4, 4);
    const std::vector<Method> list = allMethodsAndTheOriginals();
    std::vector<double> lights;
    for (int decade = -7; decade <= 38; ++decade)
        lights.push_back(std::pow(10, decade));
    Runs runs("black.exr");
    std::vector<std::vector<std::size_t>> asked(list.size());
    for (std::size_t m = 0; m < list.size(); ++m)
        for (const double light : lights) {
            nlohmann::json inject;
            for (int i = 0; i < size.x * size.y; ++i)
                inject.push_back(at(list[m].firstPass(), {i % size.x, i / size.x}, light));
            Set set = list[m].set;
            if (list[m].isPyramid()) set = set + Set{{"threshold", "0"}, {"levels", "8"}};
            asked[m].push_back(runs.of(list[m].rung).ask(set, size, list[m].target(size), inject));
        }
    runs.run();
    for (std::size_t m = 0; m < list.size(); ++m) {
        double before = 0;
        for (std::size_t i = 0; i < lights.size(); ++i) {
            const double bloom = sum(runs.of(list[m].rung).read(asked[m][i])); // throws where not finite
            if (lights[i] > 65504) continue;
            EXPECT_GE(bloom, before) << list[m].name << " of " << lights[i];
            before = bloom;
        }
        EXPECT_GT(before, 1) << list[m].name << ": nothing glows";
    }
}

// More levels than there are pixels to halve: the last ones are all one pixel. The bloom of a flat field is
// as bright as the field where it is divided by the number of levels that add their light, and seven times as
// bright where it is not: whatever the filter.
TEST_F(BloomStability, levelsBeyondAFramesSizeAddNoLightWhereTheSumIsDivided) {
    constexpr double field = 10;
    constexpr int levels = 8;
    Runs runs("black.exr");
    struct Asked {
        Method method;
        bool normalise;
        std::vector<std::size_t> frames = {};
    };
    std::vector<Asked> asked;
    for (const Method& method : pyramids())
        for (const bool normalise : {false, true}) {
            asked.push_back({method, normalise});
            const Set set = method.set + Set{{"levels", std::to_string(levels)},
                                             {"normalise", normalise ? "on" : "off"},
                                             {"strength", "1"}};
            for (const glm::ivec2 size : {glm::ivec2(1, 1), {3, 5}, {7, 1}, {16, 16}}) {
                nlohmann::json inject;
                for (int i = 0; i < size.x * size.y; ++i)
                    inject.push_back(at("scene", {i % size.x, i / size.x}, field));
                asked.back().frames.push_back(runs.of(method.rung).ask(set, size, "lit", inject));
            }
        }
    runs.run();
    for (const Asked& one : asked) {
        double largest = 0;
        for (const std::size_t i : one.frames) {
            const ColorImage lit = runs.of(one.method.rung).read(i);
            largest = std::max(largest, sum(lit) / double(lit.pixels.size()) / field - 1);
        }
        tell(one.method,
             one.normalise ? "with normalise=on"
                           : "8 levels on up to 16 px: bloom of a flat field, times its light",
             decimals(largest, 2));
        EXPECT_NEAR(largest, one.normalise ? 1 : one.method.addingLevels(levels), 0.05) << one.method.name;
    }
}

} // namespace
} // namespace gll::stability
