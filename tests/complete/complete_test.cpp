// Which cases are asked for.
#include "complete/complete.hpp"

#include <gtest/gtest.h>

namespace gll::test {
namespace {

const auto listed_settings = nlohmann::json::parse(R"({
    "rung": "02_test",
    "settings": [
        {"name": "blur", "kind": "choice", "default": "tent", "choices": ["tent", "box", "dual"]},
        {"name": "tone_map", "kind": "choice", "default": "clamp", "choices": ["clamp", "agx", "film"],
         "owner": "01_test"},
        {"name": "bloom", "kind": "toggle", "default": true},
        {"name": "exposure_ev", "kind": "number", "default": 0.0, "min": -16.0, "max": 16.0}
    ],
    "presets": [{"name": "original", "values": []}, {"name": "recommended", "values": [["blur", "dual"]]}]
})");

frame_check::Case caseOf(const std::string& request) {
    return {.name = "case", .settings = nlohmann::ordered_json::parse(request)};
}

const std::vector<frame_check::Case> all = {
    caseOf(R"({"preset": "recommended"})"),
    caseOf(R"({"set": {"blur": "box", "tone_map": "film", "bloom": false, "exposure_ev": "1"}})")};

TEST(CompleteGoldens, showEveryChoiceAndEveryOtherSettingOnce) {
    EXPECT_EQ(missingCases(listed_settings, all, {}), std::vector<std::string>{});
}

TEST(CompleteGoldens, missWhatNoCaseShows) {
    EXPECT_EQ(missingCases(listed_settings, {}, {}).size(), 5U)
        << "two blurs, a tone map, a toggle, a number";
    EXPECT_EQ(missingCases(listed_settings, {all[1]}, {}).size(), 1U);
    EXPECT_EQ(missingCases(listed_settings, {all[1]}, {}).at(0).find("blur=dual failed"), 0U);
}

TEST(CompleteGoldens, takeASettingAtItsDefaultForNone) {
    const auto at_default = caseOf(R"({"set": {"exposure_ev": "0.0", "bloom": "on", "tone_map": "clamp"}})");
    EXPECT_EQ(missingCases(listed_settings, {at_default}, {}).size(), 5U);
}

TEST(CompleteGoldens, takeAnExcuseAndRefuseOneThatIsNotNeeded) {
    EXPECT_EQ(missingCases(listed_settings, {all[1]}, {{"blur=dual", "reason"}}), std::vector<std::string>{});
    EXPECT_EQ(missingCases(listed_settings, all, {{"blur=dual", "reason"}}).size(), 1U);
    EXPECT_EQ(missingCases(listed_settings, all, {{"blurred", "reason"}}).size(), 1U);
}

TEST(CompleteGoldens, noteTheIntermediateTargetsOfEveryCase) {
    frame_check::Case golden{.name = "a", .blessed = {{}, {.targets = {{"scene", "hash"}}}}};
    EXPECT_EQ(ungroupedCases("01_x", {golden}), std::vector<std::string>{});
    golden.blessed.pop_back();
    EXPECT_EQ(ungroupedCases("01_x", {golden}).size(), 1U);
    EXPECT_NE(ungroupedCases("01_x", {golden}).at(0).find("tests/bless 01_x a"), std::string::npos);
}

} // namespace
} // namespace gll::test
