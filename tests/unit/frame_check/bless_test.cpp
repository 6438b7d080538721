// Blessing: what it writes, what it keeps, and when it refuses.
#include "frame_check/bless.hpp"

#include "frame_check/check.hpp"
#include "pictures.hpp"
#include "support/messages.hpp"

#include <cstdlib>
#include <gtest/gtest.h>
#include <stdexcept>

namespace gll::test {
namespace {

using frame_check::BlessOptions;

// Blessing is for people: these tests take the variable that says nobody is there away while they run.
class Bless : public testing::Test {
  protected:
    Bless() {
        if (const char* ci = std::getenv("CI")) ci_ = ci;
        unsetenv("CI");
    }
    ~Bless() override {
        if (ci_) setenv("CI", ci_->c_str(), 1);
    }
    bool bless(BlessOptions options) const {
        if (options.because.empty()) options.because = "looked at";
        testing::internal::CaptureStdout();
        const bool all = frame_check::bless(copying_.suite(), options);
        said_ = testing::internal::GetCapturedStdout();
        return all;
    }
    std::string refusal(const BlessOptions& options) const {
        return messageOf<std::runtime_error>([&] { frame_check::bless(copying_.suite(), options); });
    }
    std::string json(const std::string& name) const { return contents(copying_.path() / (name + ".json")); }
    frame_check::Outcome outcome(const std::string& name) const {
        return frame_check::check(copying_.suite(), {.patterns = {name}}).cases.at(0).outcome;
    }

    CopyingSuite copying_;
    mutable std::string said_;

  private:
    std::optional<std::string> ci_;
};

TEST_F(Bless, acceptsANewCaseAndNotesWhoDrewItAndWhy) {
    copying_.writeCase("a", R"({"time": 1.50})");
    copying_.draws("a", grey());
    EXPECT_TRUE(bless({.names = {"a"}, .because = "the sun is round now"}));
    EXPECT_CONTAINS(said_, "a: new picture");
    for (const std::string& part : {std::string(R"("time": 1.5)"), measure::pixelHash(grey()),
                                    std::string(R"("renderer": "a copying machine")"),
                                    std::string(R"("because": "the sun is round now")"),
                                    std::string(R"("date": "20)"), std::string(R"("cpu": )")})
        EXPECT_CONTAINS(json("a"), part);
    EXPECT_EQ(outcome("a"), frame_check::Outcome::same);
    EXPECT_EQ(contents(copying_.path() / "cases.txt"), "a\n");
    const std::string before = json("a");
    EXPECT_TRUE(bless({.names = {"a"}, .because = "again"}));
    EXPECT_CONTAINS(said_, "a: blessed already");
    EXPECT_EQ(json("a"), before);
}

TEST_F(Bless, makesACaseFromSettingsOnTheWay) {
    std::filesystem::create_directories(copying_.path());
    copying_.draws("fresh", grey());
    EXPECT_CONTAINS(refusal({.names = {"fresh"}, .because = "x"}), "no such case");
    EXPECT_TRUE(bless({.names = {"fresh"}, .because = "x", .makes = true})) << "all at their defaults";
    copying_.draws("other", grey());
    EXPECT_TRUE(
        bless({.names = {"other"},
               .because = "x",
               .makes = true,
               .settings = {"frame=7", "set.exposure=1.50", "set.tone=agx", "inject=a:1", "inject=b:2"}}));
    EXPECT_CONTAINS(json("other"), "\"frame\": 7,");
    EXPECT_CONTAINS(json("other"), "\"exposure\": \"1.50\"");
    EXPECT_CONTAINS(json("other"), "\"tone\": \"agx\"");
    EXPECT_CONTAINS(json("other"), "\"a:1\",\n    \"b:2\"");
    EXPECT_CONTAINS(refusal({.names = {"other"}, .because = "x", .makes = true}), "is there already");
    EXPECT_CONTAINS(refusal({.names = {"a/b"}, .because = "x", .makes = true}), "no name for a case");
    EXPECT_CONTAINS(refusal({.names = {"x"}, .because = "x", .makes = true, .settings = {"=3"}}),
                    "KEY=VALUE");
}

TEST_F(Bless, replacesAPictureAndKeepsTheRuleAndTheSettings) {
    copying_.writeCase("a", R"({"rule": {"rmse": 0.02, "because": "noise"}, "time": 3})");
    copying_.draws("a", grey());
    EXPECT_TRUE(bless({.names = {"a"}}));
    copying_.draws("a", changed(76800, 100));
    EXPECT_TRUE(bless({.names = {"a"}, .because = "redder"}));
    EXPECT_CONTAINS(said_, "picture replaced");
    EXPECT_CONTAINS(json("a"), "\"because\": \"noise\"");
    EXPECT_EQ(copying_.suite().cases.at(0).blessed.size(), 1U);
    EXPECT_EQ(outcome("a"), frame_check::Outcome::same);
}

TEST_F(Bless, addsWhatAnotherRendererDrawsBesideWhatIsThere) {
    copying_.writeCase("a", R"({"blessed": [{"hash": ")" + measure::pixelHash(grey()) +
                                R"(", "renderer": "another", "date": "2026-01-02"}]})");
    saveImage(copying_.path() / "a.png", grey());
    copying_.draws("a", changed(10, 1));
    EXPECT_TRUE(bless({.names = {"a"}})) << "near enough: the picture stays";
    EXPECT_CONTAINS(said_, "hash on a copying machine added");
    EXPECT_EQ(copying_.suite().cases.at(0).blessed.size(), 2U);
    copying_.draws("a", changed(11, 1));
    EXPECT_FALSE(bless({.names = {"a"}, .adds = true}));
    EXPECT_CONTAINS(said_, "has a hash of a copying machine already");

    copying_.writeCase("a", R"({"blessed": [{"hash": ")" + measure::pixelHash(grey()) +
                                R"(", "renderer": "another", "date": "2026-01-02"}]})");
    copying_.draws("a", changed(76800, 50));
    EXPECT_TRUE(bless({.names = {"a"}, .adds = true}));
    EXPECT_CONTAINS(said_, "and its picture");
    EXPECT_TRUE(std::filesystem::exists(copying_.path() / "a.2.png"));
    copying_.draws("a", changed(76801 - 2, 50));
    EXPECT_EQ(outcome("a"), frame_check::Outcome::different) << "one pixel by 50 codes";
}

TEST_F(Bless, namesWhatOfOtherRenderersGoesWithAPictureThatIsReplaced) {
    const auto by = [](const Image& image, const std::string& renderer, const std::string& more) {
        return R"({"hash": ")" + measure::pixelHash(image) + R"(", "renderer": ")" + renderer +
               R"(", "date": "2026-01-02")" + more + "}";
    };
    copying_.writeCase("a", R"({"blessed": [)" + by(grey(), "a copying machine", "") + ", " +
                                by(changed(3, 1), "the near one", "") + ", " +
                                by(changed(900, 70), "the far one", R"(, "picture": "a.2.png")") + "]}");
    saveImage(copying_.path() / "a.png", grey());
    saveImage(copying_.path() / "a.2.png", changed(900, 70));
    copying_.draws("a", changed(76800, 50));
    EXPECT_TRUE(bless({.names = {"a"}}));
    EXPECT_CONTAINS(
        said_, "picture replaced; gone with it is what was blessed of the near one, the far one (a.2.png): "
               "look at it anew, and add it there by --also");
    EXPECT_FALSE(std::filesystem::exists(copying_.path() / "a.2.png"));
    copying_.draws("a", grey());
    EXPECT_TRUE(bless({.names = {"a"}}));
    EXPECT_EQ(said_.find("gone with it"), std::string::npos) << "nobody else's was there: " << said_;
}

TEST_F(Bless, refusesInCiAndWithoutAReasonOrACase) {
    copying_.writeCase("a", "{}");
    copying_.draws("a", grey());
    EXPECT_CONTAINS(refusal({.names = {"a"}, .because = " "}), "--because TEXT");
    setenv("CI", "true", 1);
    EXPECT_CONTAINS(refusal({.names = {"a"}, .because = "x"}), "CI is set here");
    unsetenv("CI");
    EXPECT_EQ(json("a"), "{}");
}

TEST_F(Bless, refusesWhatCannotBeDrawnOrIsNotTheSameTwiceAndAcceptsTheRest) {
    copying_.writeCase("missing", "{}");
    copying_.writeCase("there", "{}");
    copying_.draws("there", grey());
    const std::string chance = (copying_.drawn() / "chance.png").string();
    copying_.draws("chance", grey());
    copying_.draws("other", changed(100, 90));
    // What it draws the first time is not what it draws the second time.
    copying_.writeCase("chance", R"({"command": ["sh", "-c", "cp ')" + chance + "' {out}; cp '" +
                                     (copying_.drawn() / "other.png").string() + "' '" + chance + "'\"]}");
    EXPECT_FALSE(bless({.names = {}}));
    EXPECT_CONTAINS(said_, "missing: NOT BLESSED: cannot be drawn: cp ended with 1");
    EXPECT_CONTAINS(said_, "chance: NOT BLESSED: is not the same twice, differ 100");
    EXPECT_CONTAINS(said_, "there: new picture");
}

} // namespace
} // namespace gll::test
