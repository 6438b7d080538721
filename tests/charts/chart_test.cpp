// The charts' own tools: the front, numbers, tables, and that a drawing depends on its points alone.
#include "charts/chart.hpp"

#include "support/temporary_folder.hpp"

#include <fstream>
#include <gtest/gtest.h>
#include <iterator>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace gll::charts {
namespace {

const std::vector<Point> points = {
    {"cheap", "", 1, 8},
    {"good", "levels 3", 2, 4},
    {"good", "levels 4", 4, 1},
    {"poor", "", 3, 6},                      // as good is, at 2
    {"same", "", 4, 1, "the original of 9"}, // as good is: neither beats the other
    {"perfect", "", 9, 0}};

std::string drawn(const test::TemporaryFolder& folder, const Axes& axes, const std::vector<Point>& list) {
    const std::filesystem::path file = folder / "chart.svg";
    drawChart(file, axes, list);
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

int count(const std::string& text, const std::string& part) {
    int found = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
        ++found;
    return found;
}

TEST(ParetoFront, holdsWhatNothingBeatsInOneWithoutLosingInTheOther) {
    EXPECT_EQ(paretoFront(points), (std::vector<bool>{true, true, true, false, true, true}));
    EXPECT_TRUE(paretoFront({}).empty());
}

TEST(ParetoFront, leavesOutWhatIsAsGoodButDearerOrAsDearButWorse) {
    EXPECT_EQ(paretoFront({{"a", "", 1, 1}, {"b", "", 2, 1}, {"c", "", 1, 2}}),
              (std::vector<bool>{true, false, false}));
}

TEST(ParetoFront, neitherHoldsNorIsBeatenByWhatDoesNotCompete) {
    EXPECT_EQ(paretoFront({{"a", "4 px", 1, 1, "", false}, {"a", "18 px", 3, 3}, {"b", "18 px", 4, 4}}),
              (std::vector<bool>{false, true, false}));
}

TEST(WorstFront, judgesAMethodByTheWorstPointOfItsDial) {
    // The first method's best point beats all others, but its worst does not.
    EXPECT_EQ(worstFront(
                  {{"a", "dark", 4, 0.1}, {"a", "bright", 4, 9}, {"b", "dark", 4, 3}, {"b", "bright", 4, 2}}),
              (std::vector<bool>{false, false, true, false}));
}

TEST(Csv, comesBackAsItWasWritten) {
    const test::TemporaryFolder folder;
    const Table table{{"method", "cost, cu", "note"},
                      {{"5 taps, tent", "9.9", ""}, {"box", "0.1", "the original of 05"}}};
    writeCsv(folder / "t.csv", table);
    const Table back = readCsv(folder / "t.csv");
    EXPECT_EQ(back.columns, table.columns);
    EXPECT_EQ(back.rows, table.rows);
}

TEST(Csv, isRefusedWhereARowHasAnotherNumberOfCells) {
    const test::TemporaryFolder folder;
    folder.write("t.csv", "a,b\n1,2\n3\n");
    EXPECT_THROW(readCsv(folder / "t.csv"), std::runtime_error);
    EXPECT_THROW(readCsv(folder / "none.csv"), std::runtime_error);
}

TEST(CostTable, namesWhatItLacks) {
    const test::TemporaryFolder folder;
    const Costs costs(folder.write("c.csv", "method,cost_cu\nbox,1.25\n"));
    EXPECT_EQ(costs.of("box", "cost_cu"), 1.25);
    try {
        costs.of("tent", "cost_cu");
        FAIL();
    } catch (const std::runtime_error& error) {
        EXPECT_NE(std::string(error.what()).find("c.csv: has no cost_cu of \"tent\""), std::string::npos)
            << error.what();
    }
    EXPECT_THROW(costs.of("box", "ns"), std::runtime_error);
}

TEST(Numbers, areShortAndNeverMinusZero) {
    EXPECT_EQ(shortNumber(0.0123456), "0.0123");
    EXPECT_EQ(shortNumber(1234567), "1.23e+06");
    EXPECT_EQ(shortNumber(-0.0), "0");
    EXPECT_EQ(decimals(2.345, 1), "2.3");
    EXPECT_EQ(decimals(-0.04, 1), "0.0");
    EXPECT_EQ(decimals(-0.06, 1), "-0.1");
}

TEST(Drawing, dependsOnThePointsAlone) {
    const test::TemporaryFolder folder;
    const Axes axes{"a title", "640x360", "cost, cu", "error, %"};
    const std::string once = drawn(folder, axes, points);
    EXPECT_EQ(once, drawn(folder, axes, points));
    std::vector<Point> other = points;
    other[0].error = 7.9;
    EXPECT_NE(once, drawn(folder, axes, other));
}

TEST(Drawing, namesAxesMethodsMarksAndTheEndsOfADial) {
    const test::TemporaryFolder folder;
    const std::string svg = drawn(folder, {"a title", "640x360", "cost, cu", "error, %"}, points);
    for (const char* text :
         {"a title", "640x360", "cost, cu", "error, %", "the original of 9", "levels 3", "levels 4"})
        EXPECT_EQ(count(svg, ">" + std::string(text) + "<"), 1) << text;
    for (const Point& point : points)
        EXPECT_EQ(count(svg, ">" + point.method + "<"), 1) << point.method;
}

TEST(Drawing, putsAnErrorOfZeroAtTheBottomOfALogarithmicAxisAndSaysSo) {
    const test::TemporaryFolder folder;
    const std::string svg = drawn(folder, {"a title", "", "x", "y", true, 0.01}, points);
    EXPECT_EQ(count(svg, "≤ 0.01"), 1);
}

TEST(Drawing, showsWhatDoesNotCompeteSmallAndSaysWhatItIs) {
    const test::TemporaryFolder folder;
    const Axes axes{.title = "a title", .x = "x", .y = "y", .others = "at other widths"};
    std::vector<Point> list = points;
    const std::string all = drawn(folder, axes, list);
    list[3].competes = false; // it is grey already
    const std::string svg = drawn(folder, axes, list);
    EXPECT_EQ(count(svg, "; at other widths<"), 1);
    EXPECT_NE(svg, all);
}

TEST(Drawing, showsWhatIsHollowAsSuchInItsMethodsShapeAndSaysWhatItIs) {
    const test::TemporaryFolder folder;
    const Axes axes{.title = "a title", .x = "x", .y = "y", .hollow = "hollow: with sugar"};
    std::vector<Point> list = points;
    const std::string circle = "#gpPt5' transform";
    const std::string full = drawn(folder, axes, list);
    EXPECT_EQ(count(full, "; hollow: with sugar<"), 1);
    EXPECT_EQ(count(full, circle), 0);
    list[0].hollow = true;
    EXPECT_EQ(count(drawn(folder, axes, list), circle), 1);
}

TEST(Drawing, namesEachMethodOnceAndInAKeyWhereThePointsLeaveNoRoom) {
    const test::TemporaryFolder folder;
    const Axes axes{.title = "a title", .x = "x", .y = "y"};
    std::vector<Point> list;
    for (int i = 0; i < 20; ++i) // all in one place
        list.push_back({"method " + std::to_string(i), "", 10 + 0.01 * i, 10});
    const std::string crowd = drawn(folder, axes, list);
    for (const Point& point : list)
        EXPECT_EQ(count(crowd, ">" + point.method + "</text>"), 1) << point.method;
    const std::string key = "<title>method "; // gnuplot's, for what has a line in its key
    EXPECT_GE(count(crowd, key), 1);
    EXPECT_EQ(count(drawn(folder, axes, points), key), 0);
}

TEST(Drawing, hasADarkVariantOfTheSamePoints) {
    const test::TemporaryFolder folder;
    const std::string light = drawn(folder, {.title = "a title", .x = "x", .y = "y"}, points);
    std::ifstream stream(folder / "chart_dark.svg", std::ios::binary);
    const std::string dark{std::istreambuf_iterator<char>(stream), {}};
    EXPECT_NE(light, dark);
    for (const Point& point : points)
        EXPECT_EQ(count(dark, point.method), count(light, point.method)) << point.method;
    EXPECT_EQ(count(light, "fill=\"#ffffff\""), count(dark, "fill=\"#0d1117\""));
}

TEST(Drawing, hasTheSameStepsBetweenPowersOfTenOfALogarithmicCost) {
    const test::TemporaryFolder folder;
    const std::string svg = drawn(folder, {.title = "a title", .x = "x", .y = "y", .log_x = true},
                                  {{"a", "", 2, 3}, {"b", "", 200, 2}, {"c", "", 800, 1}});
    for (const char* tic : {">1<", ">10<", ">100<", ">1000<"})
        EXPECT_GE(count(svg, tic), 1) << tic;
    EXPECT_EQ(count(svg, ">200<"), 0);
}

TEST(Drawing, refusesALogarithmicAxisWithoutABottomOrOfWhatCostsNothingAndAChartWithoutPoints) {
    const test::TemporaryFolder folder;
    EXPECT_THROW(drawn(folder, {"a title", "", "x", "y", true}, points), std::invalid_argument);
    EXPECT_THROW(drawn(folder, {"a title", "", "x", "y"}, {}), std::invalid_argument);
    EXPECT_THROW(drawn(folder, {.title = "a title", .x = "x", .y = "y", .log_x = true}, {{"free", "", 0, 1}}),
                 std::invalid_argument);
}

TEST(ChartJson, hasThePointsWithTheirSettingsAndTheFront) {
    const test::TemporaryFolder folder;
    std::vector<Point> list = points;
    list[1].settings = {{"levels", "3"}, {"filter", "tent"}};
    list[4].settings.emplace(); // of the defaults
    list[4].rung = "02_other";
    list[4].error = 1.00049;
    list[5].competes = false;
    drawn(folder,
          {.title = "a title",
           .subtitle = "640x360",
           .x = "cost",
           .y = "error",
           .log_y = true,
           .floor = 0.01,
           .rung = "01_rung"},
          list);
    const std::string text = test::contents(folder / "chart.json");
    const auto json = nlohmann::json::parse(text);
    EXPECT_EQ(json.at("title"), "a title");
    EXPECT_EQ(json.at("subtitle"), "640x360");
    EXPECT_EQ(json.at("x"), (nlohmann::json{{"label", "cost"}, {"log", false}}));
    EXPECT_EQ(json.at("y"), (nlohmann::json{{"label", "error"}, {"log", true}, {"floor", 0.01}}));
    const auto& all = json.at("points");
    ASSERT_EQ(all.size(), list.size());
    EXPECT_EQ(all[1], (nlohmann::json{{"method", "good"},
                                      {"dial", "levels 3"},
                                      {"x", 2.0},
                                      {"y", 4.0},
                                      {"front", true},
                                      {"competes", true},
                                      {"mark", ""},
                                      {"rung", "01_rung"},
                                      {"settings", {"filter=tent", "levels=3"}}}));
    EXPECT_EQ(all[3].at("front"), false);
    EXPECT_FALSE(all[0].contains("settings"));
    EXPECT_EQ(all[4].at("settings"), nlohmann::json::array());
    EXPECT_EQ(all[4].at("rung"), "02_other");
    EXPECT_EQ(all[4].at("y"), 1.0) << "three digits";
    EXPECT_EQ(all[4].at("mark"), "the original of 9");
    EXPECT_EQ(all[5].at("competes"), false);
    EXPECT_EQ(count(text, "\n    {"), int(list.size())) << "a line each";
}

} // namespace
} // namespace gll::charts
