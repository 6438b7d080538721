// --budget, driven as people do: against trying every combination, and on frames and sizes that it never
// looked at.
#include "charts/frames.hpp"
#include "measure/errors.hpp"
#include "measure/flip.hpp"
#include "support/process.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <gtest/gtest.h>
#include <map>
#include <set>
#include <sstream>
#include <utility>

namespace gll {
namespace {

using charts::Frames;
using charts::Set;
using nlohmann::json;

std::filesystem::path programs;
std::vector<std::string> rungs; // all that there are

struct Case {
    std::string rung;
    std::string budget;
    Set set; // the look that is asked for
    std::string preset = "original";
    std::string image = {}; // in place of the scene

    std::string name() const {
        std::string text = rung + " --preset " + preset + " --budget " + budget;
        for (const auto& [key, value] : set)
            text += " " + key + "=" + value;
        return text;
    }
    double limit() const { return std::stod(budget.substr(budget.find('=') + 1)); }
    bool isEv() const { return budget.starts_with("ev"); }
};

std::vector<std::string> words(const Case& one, std::vector<std::string> more) {
    more.insert(more.end(), {"--headless", "--preset", one.preset});
    for (const auto& [key, value] : one.set)
        more.insert(more.end(), {"--set", key + "=" + value});
    if (!one.image.empty()) more.insert(more.end(), {"--image", one.image});
    return more;
}

std::string text(glm::ivec2 size) { return std::to_string(size.x) + "x" + std::to_string(size.y); }

json search(const Case& one, glm::ivec2 size, const char* counter, std::vector<std::string> more = {}) {
    more.insert(more.end(), {"--budget", one.budget, "--json", "--size", text(size), "--counter", counter});
    return json::parse(
        test::runToSuccess({programs / one.rung, words(one, std::move(more))}, std::chrono::minutes(9)).out);
}

Set setOf(const json& object) {
    Set set;
    for (const auto& [name, value] : object.items())
        set[name] = value;
    return set;
}

Set operator+(Set left, const Set& right) {
    for (const auto& [name, value] : right)
        left[name] = value;
    return left;
}

struct View {
    int frame = 1;
    glm::ivec2 size{1};
};

// For each of some settings its error in each view against the first of them, in the budget's unit.
std::vector<std::vector<double>> errors(const Case& one, const std::vector<Set>& sets,
                                        const std::vector<View>& views) {
    std::vector<std::vector<double>> result(sets.size());
    if (one.isEv()) {
        const test::TemporaryFolder folder;
        std::string lines;
        for (const Set& set : sets)
            for (const View& view : views)
                lines +=
                    json{{"set", set}, {"size", text(view.size)}, {"frame", view.frame}, {"readings", true}}
                        .dump() +
                    "\n";
        std::istringstream printed(
            test::runToSuccess(
                {programs / one.rung,
                 words(one, {"--json", "--batch", folder.write("batch.jsonl", lines).string()})})
                .out);
        std::vector<double> all;
        for (std::string line; std::getline(printed, line);)
            all.push_back(json::parse(line).at("readings").at("exposure_ev"));
        for (std::size_t s = 0; s < sets.size(); ++s)
            for (std::size_t v = 0; v < views.size(); ++v)
                result[s].push_back(std::abs(all.at(s * views.size() + v) - all.at(v)));
        return result;
    }
    std::vector<std::string> arguments;
    if (!one.image.empty()) arguments = {"--image", one.image};
    Frames frames(programs / one.rung, arguments);
    for (const Set& set : sets)
        for (const View& view : views)
            frames.ask(one.set + set, view.size, "frame", {}, view.frame, one.preset);
    frames.run();
    for (std::size_t s = 0; s < sets.size(); ++s)
        for (std::size_t v = 0; v < views.size(); ++v)
            result[s].push_back(
                measure::summary(measure::flip(frames.read(s * views.size() + v), frames.read(v))).mean);
    return result;
}

double worst(const std::vector<double>& of) { return *std::max_element(of.begin(), of.end()); }

const std::vector<Case> cases = {
    {"01_hdr", "flip=0.01", {}},
    {"01_hdr", "flip=0.1", {}},
    {"02_auto_exposure", "ev=0.02", {}},
    {"02_auto_exposure", "ev=0.3", {{"adapt", "off"}}},
    {"03_gaussian_bloom", "flip=0.02", {}},
    {"03_gaussian_bloom", "flip=0.05", {{"sigma", "8"}}},
    {"04_pyramid_bloom", "flip=0.05", {}, "recommended"},
    {"04_pyramid_bloom", "flip=0.02", {{"strength", "0.05"}}},
    {"05_hdr_bloom", "flip=0.08", {}},
    {"05_hdr_bloom", "flip=0.02", {{"intensity", "0.05"}}, "recommended"},
};

TEST(Budget, isKeptOnFramesAndSizesThatWereNotLookedAt) {
    for (const Case& one : cases) {
        const json found = search(one, {160, 120}, "cpu");
        const Set best = setOf(found["best"]);
        std::vector<View> views;
        for (const int frame : {1, 37, 143, 311, 500, 717, 890, 1234})
            views.push_back({frame, {160, 120}});
        for (const glm::ivec2 size : {glm::ivec2(200, 150), {81, 127}, {177, 65}, {240, 135}})
            views.push_back({97, size});
        const double error = worst(errors(one, {best, setOf(found["picked"])}, views)[1]);
        std::printf("%s: %s, error %.4f where it was tuned, %.4f elsewhere\n", one.name().c_str(),
                    found["picked"].dump().c_str(), found["error"].get<double>(), error);
        EXPECT_LE(error, one.limit()) << one.name();
    }
}

// What --settings says a budget chooses from; none where a rung has nothing of the kind.
json dialsOf(const std::string& rung) {
    return json::parse(test::runToSuccess({programs / rung, {"--settings", "--json"}}).out)
        .value("dials", json::array());
}

// Every combination of those.
std::vector<Set> combinations(const Case& one) {
    std::vector<Set> all{{}};
    for (const json& dial : dialsOf(one.rung)) {
        const std::string name = dial.at("setting");
        std::vector<std::string> values = dial.at("values");
        if (values.empty())
            for (int value = std::stoi(one.set.at(name)); value >= 1; --value)
                values.push_back(std::to_string(value));
        std::vector<Set> next;
        for (const Set& set : all)
            for (const std::string& value : values)
                next.push_back(set + Set{{name, value}});
        all = next;
    }
    return all;
}

// The swarm as a picture: drawing it again costs little, so that a tenth of the frame is a tenth of the bloom
// too.
std::string swarmPicture(const test::TemporaryFolder& folder, glm::ivec2 size) {
    const std::string swarm = (folder / "swarm.exr").string();
    Frames scene(programs / "05_hdr_bloom");
    scene.ask({}, size, "hdr");
    scene.run();
    std::filesystem::copy_file(scene.file(0), swarm);
    return swarm;
}

// In early frames: an eye that adapts has all frames before rendered, and under callgrind counted one by one.
// That a budget is kept in later ones is for another test.
void findsTheOptimum(const Case& one, glm::ivec2 size) {
    const json found = search(one, size, "callgrind", {"--frames", "2..10"});
    // What it keeps for frames that it has not looked at, the others keep too.
    const double limit = found["error_to_spend"];
    std::vector<View> views;
    for (const json& view : found["views"])
        views.push_back({view["frame"], {view["size"][0], view["size"][1]}});
    const std::vector<Set> all = combinations(one);
    const auto first_view = errors(one, all, {views[0]}); // the first of all is the best
    std::vector<Set> candidates{all[0]};
    for (std::size_t i = 1; i < all.size(); ++i)
        if (first_view[i][0] <= limit) candidates.push_back(all[i]);
    const auto everywhere = errors(one, candidates, views);
    std::vector<Set> within{setOf(found["picked"])};
    for (std::size_t i = 0; i < candidates.size(); ++i)
        if (worst(everywhere[i]) <= limit) within.push_back(candidates[i]);
    for (Set& set : within)
        set = one.set + set;
    within.push_back(one.set); // the settings before
    std::vector<std::string> arguments{"--frame", "2", "--preset", one.preset};
    if (!one.image.empty()) arguments.insert(arguments.end(), {"--image", one.image});
    std::vector<double> costs;
    for (const json& report : charts::costs(programs / one.rung, within, size, arguments))
        costs.push_back(report.at("sum_cu"));
    const double before = costs.back();
    costs.pop_back();
    const double least = *std::min_element(costs.begin(), costs.end());
    std::printf("%s: %s at %.3f cu (predicted %.3f); the best of %zu combinations, %zu within the budget, is "
                "%.3f; %d were tried\n",
                one.name().c_str(), found["picked"].dump().c_str(), costs[0], found["cost_cu"].get<double>(),
                all.size(), within.size() - 2, least, found["tried"].get<int>());
    EXPECT_LE(costs[0], 1.1 * least) << one.name();
    // What it says the pick costs is put together from passes measured one change at a time.
    EXPECT_NEAR(found["cost_cu"].get<double>() / costs[0], 1, 0.02) << one.name();
    EXPECT_NEAR(found["present_cost_cu"].get<double>() / before, 1, 0.02) << one.name();
}

// One for each rung whose settings a budget can choose from.
const std::vector<Case> optima = {
    {"01_hdr", "flip=0.1", {}},
    {"02_auto_exposure", "ev=0.3", {{"overlay", "off"}}},
    {"03_gaussian_bloom", "flip=0.05", {{"sigma", "4"}}, "original", "swarm"},
    {"04_pyramid_bloom", "flip=0.03", {{"levels", "2"}}, "recommended", "swarm"},
    {"05_hdr_bloom", "flip=0.06", {{"levels", "3"}, {"intensity", "0.1"}}, "recommended", "swarm"},
    {"07_shadow_map", "flip=0.015", {{"scene", "plot"}}, "recommended"},
    {"08_ssao", "flip=0.02", {{"scene", "room"}}, "recommended"},
    {"09_environment_light", "flip=0.02", {}, "recommended"},
};

// Rungs whose combinations take too long to try: why, and a budget that the search keeps anyhow.
const std::map<std::string, std::pair<std::string, Case>> too_many = {
    {"06_gbuffer", {"576 layouts, each compiled anew under callgrind", {"06_gbuffer", "flip=0.02", {}}}},
    {"10_deferred",
     {"80 frames of eight passes, each under callgrind", {"10_deferred", "flip=0.02", {}, "recommended"}}}};

// Under callgrind these take minutes together, so tests/budget/CMakeLists.txt runs each as a test of its own.
class BudgetFindsWhatTryingEverythingFindsToWithinATenthOfItsCost
    : public testing::TestWithParam<std::string> {};

TEST_P(BudgetFindsWhatTryingEverythingFindsToWithinATenthOfItsCost, in) {
    const std::string& rung = GetParam();
    const auto found =
        std::find_if(optima.begin(), optima.end(), [&](const Case& one) { return one.rung == rung; });
    if (const auto excused = too_many.find(rung); excused != too_many.end()) {
        const json picked = search(excused->second.second, {120, 90}, "cpu");
        EXPECT_LE(picked["error"].get<double>(), 0.02) << excused->second.first;
        EXPECT_FALSE(picked["not_needed"].empty());
        return;
    }
    if (found == optima.end()) {
        EXPECT_EQ(dialsOf(rung), json::array())
            << "a budget chooses from these: give " << rung << " a case in optima";
        return;
    }
    const glm::ivec2 size(80, 60);
    const test::TemporaryFolder folder;
    Case one = *found;
    if (one.image == "swarm") one.image = swarmPicture(folder, size);
    findsTheOptimum(one, size);
}

std::string itself(const testing::TestParamInfo<std::string>& rung) { return rung.param; }

INSTANTIATE_TEST_SUITE_P(Optimum, BudgetFindsWhatTryingEverythingFindsToWithinATenthOfItsCost,
                         testing::ValuesIn(rungs), itself);

TEST(Budget, leavesOutBloomWhereNothingIsBright) {
    for (const char* rung : {"03_gaussian_bloom", "04_pyramid_bloom", "05_hdr_bloom"}) {
        const json found = search({rung, "flip=0.001", {{"threshold", "1000"}}}, {160, 120}, "cpu");
        EXPECT_EQ(found["set"].value("bloom", ""), "off") << rung;
        EXPECT_EQ(found["not_needed"][0], "bloom") << rung;
        EXPECT_EQ(found["error"], 0) << rung;
        EXPECT_LT(found["cost_cu"], found["best_cost_cu"]) << rung;
    }
}

TEST(Budget, leavesOutNothingThatATightBudgetNeeds) {
    const json found = search({"04_pyramid_bloom", "flip=0.0001", {}, "recommended"}, {160, 120}, "cpu");
    EXPECT_EQ(found["set"], json::object());
    EXPECT_EQ(found["not_needed"], json::array());
}

TEST(Budget, looksAtASequenceFromItsFirstFrameToItsLast) {
    const auto frames = [](const char* range) {
        const json found = json::parse(test::runToSuccess({programs / "05_hdr_bloom",
                                                           {"--budget", "rmse=0.5", "--json", "--frames",
                                                            range, "--size", "64x48", "--counter", "cpu"}})
                                           .out);
        std::set<int> numbers;
        for (const json& view : found["views"])
            numbers.insert(view["frame"].get<int>());
        return numbers;
    };
    EXPECT_EQ(frames("100..102"), (std::set<int>{100, 101, 102}));
    EXPECT_EQ(frames("1..601"), (std::set<int>{1, 151, 301, 451, 601}));
}

TEST(Budget, saysWhatTheSettingsBeforeCostAndHowFarOffTheyAre) {
    const Case one{"05_hdr_bloom", "flip=0.1", {}};
    const glm::ivec2 size(64, 48);
    const json found = search(one, size, "cpu"); // costs are compared with exact ones in the test before
    std::vector<View> views;
    for (const json& view : found["views"])
        views.push_back({view["frame"], {view["size"][0], view["size"][1]}});
    const double error = worst(errors(one, {setOf(found["best"]), {}}, views)[1]);
    EXPECT_NEAR(found["present_error"].get<double>(), error, 1e-6);
    EXPECT_GT(error, 0.1) << "with settings that are over the budget, more would be seen";
    const std::string line = found["lines"][2];
    EXPECT_TRUE(line.starts_with("before: ")) << line;
    EXPECT_TRUE(line.ends_with("over the budget")) << line;
}

TEST(Budget, printsFourLinesAndRendersWhatItPicked) {
    const test::TemporaryFolder folder;
    const std::string out = (folder / "picked.png").string();
    const std::string again = (folder / "again.png").string();
    const Case one{"05_hdr_bloom", "rmse=0.02", {{"intensity", "0.1"}}};
    const std::string printed =
        test::runToSuccess(
            {programs / one.rung, words(one, {"--budget", one.budget, "--size", "160x120", "--out", out})})
            .out;
    EXPECT_EQ(std::count(printed.begin(), printed.end(), '\n'), 5)
        << printed; // and that the file was written
    for (const char* beginning : {"picked: ", "\ncosts: ", "\nbefore: ", "\nnot needed: "})
        EXPECT_NE(printed.find(beginning), std::string::npos) << printed;
    std::vector<std::string> pasted = words(one, {"--size", "160x120", "--out", again});
    std::istringstream picked(printed.substr(0, printed.find(';')));
    for (std::string word; picked >> word;)
        if (word != "picked:") pasted.push_back(word);
    test::runToSuccess({programs / one.rung, pasted});
    EXPECT_EQ(loadImage(out).pixels, loadImage(again).pixels);
}

TEST(Budget, saysWhatIsWrongWithIt) {
    const auto complaint = [](const char* rung, std::vector<std::string> arguments) {
        const test::Result result = test::run({programs / rung, std::move(arguments)});
        EXPECT_EQ(result.exit_code, 2) << result.err;
        return result.err;
    };
    for (const char* budget :
         {"flip", "flip=", "flip=0", "flip=-1", "flip=nan", "flip=2", "flip=0.1x", "psnr=40", "=1"})
        EXPECT_NE(complaint("01_hdr", {"--budget", budget}).find("write flip=LIMIT"), std::string::npos)
            << budget;
    EXPECT_NE(complaint("01_hdr", {"--budget", "ev=0.1"}).find("meters no exposure"), std::string::npos);
    EXPECT_NE(complaint("01_hdr", {"--budget", "flip=0.1", "--cost"}).find("excludes"), std::string::npos);
}

} // namespace
} // namespace gll

int main(int argc, char** argv) {
    if (argc < 3) {
        std::fprintf(stderr, "budget: error: name the folder of the rungs' programs, and the rungs\n");
        return 2;
    }
    gll::programs = argv[1];
    std::copy_if(argv + 2, argv + argc, std::back_inserter(gll::rungs),
                 [](std::string_view word) { return !word.starts_with("--"); });
    testing::InitGoogleTest(&argc, argv); // which makes a test of each rung
    return RUN_ALL_TESTS();
}
