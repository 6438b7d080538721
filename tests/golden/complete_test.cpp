// Which cases are asked for, where their files are, and that a case which is gone is missed.
#include "golden/complete.hpp"

#include "support/temporary_folder.hpp"

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

GoldenCase caseOf(const std::string& request) {
    return {.name = "case", .request = nlohmann::ordered_json::parse(request), .blessed = {}};
}

const std::vector<GoldenCase> all = {
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

TEST(GoldenCases, nameTheirFilesFromTheirFolder) {
    const GoldenCase golden = caseOf(R"({"image": "../a.exr", "mesh": "b.gltf", "floor": "c.mtl",
                                         "environment": "d.hdr", "preset": "original"})");
    const auto line = batchLine(golden, "goldens");
    EXPECT_EQ(line.at("image"), "goldens/../a.exr");
    EXPECT_EQ(line.at("mesh"), "goldens/b.gltf");
    EXPECT_EQ(line.at("floor"), "goldens/c.mtl");
    EXPECT_EQ(line.at("environment"), "goldens/d.hdr");
    EXPECT_EQ(line.at("preset"), "original");
}

TEST(GoldenList, missesACaseThatIsGoneAndOneThatItDoesNotKnow) {
    const TemporaryFolder folder;
    EXPECT_EQ(differencesToList(folder.path(), {all[0]}).size(), 1U);
    addToList(folder.path(), "case");
    addToList(folder.path(), "case");
    EXPECT_EQ(differencesToList(folder.path(), {all[0]}), std::vector<std::string>{});
    EXPECT_EQ(differencesToList(folder.path(), {}).size(), 1U);
}

} // namespace
} // namespace gll::test
