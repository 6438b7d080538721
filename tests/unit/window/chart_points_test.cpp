// Charts read for the panel: whose points they are, and which of them the settings are.
#include "support/messages.hpp"
#include "support/temporary_folder.hpp"
#include "window/chart_points.hpp"

#include <gtest/gtest.h>
#include <stdexcept>

namespace gll::test {
namespace {

constexpr const char* head = R"({"title": "a title", "subtitle": "640x480",
  "x": {"label": "cost, cu", "log": false}, "y": {"label": "error", "log": true, "floor": 0.01}, "points": [)";

std::string chart(const std::string& points) { return head + points + "]}"; }

std::string point(const std::string& rung, const std::string& settings, double y = 1) {
    return R"({"method": "m", "dial": "taps 3", "x": 2, "y": )" + std::to_string(y) +
           R"(, "front": true, "competes": false, "mark": "recommended", "rung": ")" + rung +
           R"(", "settings": [)" + settings + "]}";
}

class ChartPointsTest : public testing::Test {
  protected:
    ChartPointsTest() {
        settings.choice("filter", "box", {"box", "tent"}, "help");
        settings.integer("levels", 5, 1, 8, "help");
        settings.number("radius", 0.5, 0, 2, "help");
        settings.number("light", 1, 0, 9, "help");
    }
    std::vector<Chart> charts() { return chartsOf(folder.path(), "04_rung", settings); }
    std::string errorOf(const std::string& text) {
        const auto file = folder.write("04_rung/charts/bad.json", text);
        const std::string error = messageOf<std::runtime_error>([&] { charts(); });
        EXPECT_TRUE(error.starts_with(file.string() + ": ")) << error;
        return error;
    }

    TemporaryFolder folder;
    Settings settings;
};

TEST_F(ChartPointsTest, aChartHasItsAxesAndPoints) {
    folder.write("04_rung/charts/a.json", chart(point("04_rung", R"("filter=tent")", 0.001)));
    const std::vector<Chart> all = charts();
    ASSERT_EQ(all.size(), 1U);
    EXPECT_EQ(all[0].title, "a title");
    EXPECT_EQ(all[0].subtitle, "640x480");
    EXPECT_EQ(all[0].x.label, "cost, cu");
    EXPECT_FALSE(all[0].x.is_log);
    EXPECT_TRUE(all[0].y.is_log);
    EXPECT_EQ(all[0].y.floor, 0.01);
    ASSERT_EQ(all[0].points.size(), 1U);
    const ChartPoint& only = all[0].points[0];
    EXPECT_EQ(only.method, "m");
    EXPECT_EQ(only.dial, "taps 3");
    EXPECT_EQ(only.mark, "recommended");
    EXPECT_EQ(only.x, 2);
    EXPECT_EQ(only.y, 0.001);
    EXPECT_TRUE(only.is_on_front);
    EXPECT_FALSE(only.competes);
}

TEST_F(ChartPointsTest, chartsAreThoseWithPointsOfTheRungItsOwnFirst) {
    folder.write("03_other/charts/both.json", chart(point("03_other", "") + "," + point("04_rung", "")));
    folder.write("03_other/charts/others.json", chart(point("03_other", R"("unknown=1")")));
    folder.write("04_rung/charts/own.json", chart(point("04_rung", "")));
    folder.write("04_rung/charts/table.csv", "no chart");
    folder.write("05_none/README.md", "no charts");
    const std::vector<Chart> all = charts();
    ASSERT_EQ(all.size(), 2U);
    EXPECT_EQ(all[0].points.size(), 1U);
    EXPECT_EQ(all[1].points.size(), 2U);
    EXPECT_TRUE(all[1].points[0].values.empty()) << "another rung's";
}

TEST_F(ChartPointsTest, thePresentPointIsFoundByWhatThePointsDifferIn) {
    folder.write("04_rung/charts/a.json",
                 chart(point("04_rung", "") + "," + point("04_rung", R"("filter=tent", "levels=3")") + "," +
                       point("04_rung", R"("radius=0.75")")));
    settings.set("light=7");
    settings.set("levels=3");
    const Chart chart = charts().at(0);
    EXPECT_EQ(settings.changed(), (std::vector<std::string>{"levels=3", "light=7"})) << "as they were";
    const auto present = [&] {
        std::vector<bool> all;
        for (const ChartPoint& point : chart.points)
            all.push_back(isPresent(point, settings));
        return all;
    };
    EXPECT_EQ(present(), (std::vector<bool>{false, false, false}));
    settings.set("filter=tent");
    EXPECT_EQ(present(), (std::vector<bool>{false, true, false}));
    settings.applyPreset("original");
    EXPECT_EQ(present(), (std::vector<bool>{true, false, false}));
    settings.set("radius=0.750");
    EXPECT_EQ(present(), (std::vector<bool>{false, false, true}));
    // What is set for a point: all that the points differ in, and nothing else.
    EXPECT_EQ(chart.points[1].values, (std::map<std::size_t, double>{{0, 1}, {1, 3}, {2, 0.5}}));
}

TEST_F(ChartPointsTest, costsCountedHereLieWhereMostPointsAgree) {
    folder.write("04_rung/charts/a.json",
                 chart(point("04_rung", "") + "," + point("03_other", R"("levels=2")") + "," +
                       point("04_rung", R"("filter=tent", "levels=3")") + "," +
                       point("04_rung", R"("radius=0.75")")));
    const Chart chart = charts().at(0); // all at 2 cu
    EXPECT_FALSE(countsCopies(chart)) << "its x is in cu, and does not say of what";
    EXPECT_EQ(drawablePoints(chart),
              (std::vector<std::vector<std::string>>{{}, {"filter=tent", "levels=3"}, {"radius=0.75"}}));
    const CostsHere here = costsHere(chart, {7, 12, 7.5}, 9);
    EXPECT_EQ(here.shared, 5.5);
    EXPECT_EQ(here.points, (std::vector<double>{1.5, 6.5, 2}));
    EXPECT_EQ(here.present, 3.5);
    EXPECT_THROW(costsHere(chart, {7, 12}, 9), std::logic_error);
    EXPECT_THROW(costsHere(chart, {7, 12, 7.5, 8}, 9), std::logic_error);
}

TEST_F(ChartPointsTest, whatIsNoChartIsSaidWithItsFile) {
    EXPECT_CONTAINS(errorOf("{"), "parse error");
    EXPECT_CONTAINS(errorOf("{}"), "title");
    EXPECT_CONTAINS(errorOf(chart("")), "has no points");
    EXPECT_CONTAINS(errorOf(chart("{}")), "method");
    EXPECT_CONTAINS(errorOf(chart("7")), "type");
    EXPECT_CONTAINS(errorOf(chart(point("04_rung", "7"))), "string");
    EXPECT_CONTAINS(errorOf(chart(point("04_rung", R"("levels")"))), "has no =");
    std::string huge = chart(point("04_rung", ""));
    huge.replace(huge.find("\"x\": 2"), 6, "\"x\": 1e999");
    EXPECT_NE(errorOf(huge), "");
    std::string negative = chart(point("04_rung", ""));
    negative.replace(negative.find("\"floor\": 0.01"), 13, "\"floor\": 0");
    negative.replace(negative.find("\"y\": 1"), 6, "\"y\": -1");
    EXPECT_CONTAINS(errorOf(negative), "no place on the axes");
}

TEST_F(ChartPointsTest, aSettingThatTheRungHasNotIsAnErrorAndLeavesTheSettingsAlone) {
    settings.set("levels=3");
    EXPECT_CONTAINS(errorOf(chart(point("04_rung", R"("levels=4", "depth=1")"))), "depth");
    EXPECT_CONTAINS(errorOf(chart(point("04_rung", R"("levels=9")"))), "levels");
    EXPECT_EQ(settings.changed(), std::vector<std::string>{"levels=3"});
}

} // namespace
} // namespace gll::test
