// Cost: every pass is reported, a copy costs about one copy, and both reports are well formed.
#include "run/cost.hpp"

#include <cstdlib>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace gll::test {
namespace {

// What prepareCost() does: the counted thread does all the work. Mesa asks once a process, so before any
// test.
[[maybe_unused]] const int no_threads = setenv("LP_NUM_THREADS", "0", 1);

// Three passes that all are the unit itself: a one-tap copy of RGBA16F, the last at half size.
class Copies final : public Rung {
  public:
    explicit Copies(ShaderLibrary& shaders) : copy_(shaders.fullScreen("lib/copy.frag")) {}
    void render(Frame& frame) override {
        for (Framebuffer* target : {&from_, &to_})
            target->resize(frame.size());
        half_.resize(glm::max(frame.size() / 2, 1));
        frame.pass("copy", to_, {.program = copy_, .inputs = {{"source", from_.color()}}});
        frame.pass("half", half_, {.program = copy_, .inputs = {{"source", from_.color()}}});
        frame.pass("present", frame.presented(), {.program = copy_, .inputs = {{"source", to_.color()}}});
    }

  private:
    const Program& copy_;
    Framebuffer from_{{{"from"}}, {1, 1}};
    Framebuffer to_{{{"to"}}, {1, 1}};
    Framebuffer half_{{{"half"}}, {1, 1}};
};

class CostTest : public testing::Test {
  protected:
    CostReport measured(CounterKind counter, bool passes_only = false) {
        Renderer renderer(*context, info, {});
        return measureCost(renderer, info, 60, {512, 384}, counter, passes_only);
    }

    RungInfo info{.name = "99_copies", .summary = "Copies.", .make = [](RungResources resources) {
                      return std::make_unique<Copies>(resources.shaders);
                  }};
    std::unique_ptr<Context> context = makeHeadlessContext();
};

TEST_F(CostTest, theCpuCounterReportsEveryPassInOrder) {
    const CostReport report = measured(CounterKind::cpu);
    EXPECT_EQ(report.counter, "cpu");
    EXPECT_EQ(report.unit, "ns");
    EXPECT_EQ(report.rung, "99_copies");
    EXPECT_EQ(report.frame, 60);
    ASSERT_EQ(report.passes.size(), 3U);
    EXPECT_EQ(report.passes[0].name, "copy");
    EXPECT_EQ(report.passes[1].name, "half");
    EXPECT_EQ(report.passes[2].name, "present");
    EXPECT_EQ(report.passes[1].size, glm::ivec2(256, 192));
    EXPECT_DOUBLE_EQ(report.passes[0].bytes_per_pixel, 16);
    for (const PassCost& pass : report.passes) {
        EXPECT_GT(pass.amount, 0) << pass.name;
        EXPECT_GT(pass.time_ms, 0) << pass.name;
    }
    EXPECT_GT(report.frame_amount.value(), 0);
    EXPECT_GT(report.copy_per_pixel, 0);
}

TEST_F(CostTest, ofPassesOnlyLeavesOutTheWholeFrame) {
    const CostReport report = measured(CounterKind::cpu, true);
    ASSERT_EQ(report.passes.size(), 3U);
    EXPECT_GT(report.passes[0].amount, 0);
    EXPECT_FALSE(report.frame_amount);
    const auto json = nlohmann::json::parse(costJson(report));
    EXPECT_EQ(json["passes"].size(), 3U);
    EXPECT_GT(json["sum_cu"], 0);
    for (const char* key : {"frame_amount", "frame_cu", "frame_ms"})
        EXPECT_FALSE(json.contains(key)) << key;
    EXPECT_EQ(costTable(report).find("hole frame"), std::string::npos) << costTable(report);
}

// CPU time on a busy machine: margins so wide that only a wrong unit, area or counter breaks them.
TEST_F(CostTest, aCopyCostsAboutOneCopyAndAQuarterOfThePixelsLess) {
    const CostReport report = measured(CounterKind::cpu);
    const double pixels = 512.0 * 384.0;
    const double copy_cu = report.passes[0].amount / pixels / report.copy_per_pixel;
    const double half_cu = report.passes[1].amount / pixels / report.copy_per_pixel;
    EXPECT_GT(copy_cu, 0.4);
    EXPECT_LT(copy_cu, 2.5);
    EXPECT_LT(half_cu, 0.6 * copy_cu);
}

TEST_F(CostTest, anInstructionCountIsExactWhereThereIsOne) {
    CostReport report;
    try {
        report = measured(CounterKind::perf);
    } catch (const std::runtime_error& error) {
        EXPECT_PRED_FORMAT2(testing::IsSubstring, "instruction counter", error.what());
        GTEST_SKIP() << error.what();
    }
    EXPECT_EQ(report.unit, "instructions");
    EXPECT_NEAR(report.passes[0].amount / 512 / 384 / report.copy_per_pixel, 1, 0.05);
}

TEST_F(CostTest, countersThatCannotWorkHereSaySo) {
    EXPECT_THROW(measured(CounterKind::gpu), std::runtime_error);
    EXPECT_THROW(measured(CounterKind::callgrind), std::runtime_error);
}

TEST_F(CostTest, automaticCountsWithSomethingAndSaysWhyWhenItFellBack) {
    const CostReport report = measured(CounterKind::automatic);
    EXPECT_TRUE(report.counter == "perf" || (report.counter == "cpu" && !report.note.empty()))
        << report.counter << ": " << report.note;
}

// A report with round numbers.
CostReport report() {
    return {.rung = "99_copies",
            .renderer = "a \"renderer\"\\",
            .counter = "perf",
            .note = {},
            .unit = "instructions",
            .frame = 7,
            .size = {10, 4},
            .copy_per_pixel = 50,
            .passes = {{"full", {10, 4}, 4000, 16, 0.5}, {"half", {5, 2}, 1000, 8, 0.25}},
            .frame_amount = 6000,
            .frame_time_ms = 1};
}

TEST(CostReportTest, jsonIsOneWellFormedLineWhoseCopiesAddUp) {
    const std::string text = costJson(report());
    EXPECT_EQ(text.find('\n'), text.size() - 1);
    const auto json = nlohmann::json::parse(text);
    EXPECT_EQ(json["renderer"], "a \"renderer\"\\");
    EXPECT_EQ(json["size"], (std::vector<int>{10, 4}));
    ASSERT_EQ(json["passes"].size(), 2U);
    EXPECT_DOUBLE_EQ(json["passes"][0]["per_pixel"], 100);
    EXPECT_DOUBLE_EQ(json["passes"][0]["cu"], 2);
    EXPECT_DOUBLE_EQ(json["passes"][1]["per_pixel"], 100);
    EXPECT_DOUBLE_EQ(json["passes"][1]["cu"], 0.5);
    EXPECT_DOUBLE_EQ(json["sum_cu"], 2.5);
    EXPECT_DOUBLE_EQ(json["frame_cu"], 3);
    EXPECT_FALSE(json.contains("note"));
    CostReport fallen_back = report();
    fallen_back.note = "no counter";
    EXPECT_EQ(nlohmann::json::parse(costJson(fallen_back))["note"], "no counter");
}

TEST(CostReportTest, theTableHasARowForEveryPassTheSumAndTheWholeFrame) {
    const std::string table = costTable(report());
    for (const char* part : {"full", "half", "sum", "whole frame", "one copy (cu) is 50.0 instr/px", "10x4",
                             "5x2", "2.500", "3.000"})
        EXPECT_PRED_FORMAT2(testing::IsSubstring, part, table);
    EXPECT_EQ(table.back(), '\n');
}

} // namespace
} // namespace gll::test
