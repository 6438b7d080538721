// Bloom at its limits, in 03, 04 and 05: NaN and infinity in any pass, light of any strength, more levels
// than there are pixels.
#include "bloom_stability.hpp"

#include <cmath>
#include <cstdio>
#include <glm/common.hpp>

namespace gll::stability {
namespace {

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
